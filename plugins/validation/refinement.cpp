#include "plugins/validation/refinement.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace lightwell {
namespace {

class Refinement {
public:
    Refinement(const MeasureSome& measure, const WorkRange& range, std::vector<WantedQuantity>& quantities)
        : measure_(measure), range_(range), quantities_(quantities), needed_(quantities.size(), range.least),
          seen_(quantities.size(), 0)
    {
    }

    void run()
    {
        std::vector<std::size_t> all(quantities_.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        constexpr double apart = 4;
        for (double work = range_.pilot; work <= range_.least / apart; work *= apart)
            pilot(all, work);
        constexpr int most_rounds = 8;
        for (int round = 0; round < most_rounds; ++round)
            for (const auto& [work, group] : groups())
                step(group, work);
    }

private:
    /// Those not known yet, by the work they need: to a power of two; where samples are many, and their number costs
    /// minutes, also to one and a half of one.
    std::map<double, std::vector<std::size_t>> groups() const
    {
        if (range_.together)
            return together();
        constexpr double many = 1U << 14;
        std::map<double, std::vector<std::size_t>> found;
        for (std::size_t i = 0; i < quantities_.size(); ++i) {
            if (quantities_[i].known)
                continue;
            const double whole = std::exp2(std::ceil(std::log2(needed_[i]))), less = 0.75 * whole;
            found[std::min(whole > many && less >= needed_[i] ? less : whole, range_.most)].push_back(i);
        }
        return found;
    }

    std::map<double, std::vector<std::size_t>> together() const
    {
        std::vector<std::size_t> unknown;
        double most = 0;
        for (std::size_t i = 0; i < quantities_.size(); ++i)
            if (!quantities_[i].known) {
                unknown.push_back(i);
                most = std::max(most, needed_[i]);
            }
        if (unknown.empty())
            return {};
        return {{std::min(most, range_.most), unknown}};
    }

    /// A guess from far fewer samples is poor: more of them first.
    void step(const std::vector<std::size_t>& group, double work)
    {
        constexpr double far = 32, nearer = 1.0 / 8;
        double least_seen = std::numeric_limits<double>::infinity();
        for (const std::size_t i : group)
            least_seen = std::min(least_seen, seen_[i]);
        if (least_seen * far < work)
            pilot(group, work * nearer);
        else
            keep(group, work);
    }

    void pilot(const std::vector<std::size_t>& group, double work)
    {
        const std::vector<MeasuredValue> found = measure_(group, work);
        for (std::size_t k = 0; k < group.size(); ++k)
            learn(group[k], found[k].error, work);
    }

    void keep(const std::vector<std::size_t>& group, double work)
    {
        constexpr double more = 2;
        const std::vector<MeasuredValue> found = measure_(group, work);
        for (std::size_t k = 0; k < group.size(); ++k) {
            WantedQuantity& quantity = quantities_[group[k]];
            quantity.found = found[k];
            quantity.known = found[k].error <= quantity.wanted || work >= range_.most;
            if (!quantity.known) {
                needed_[group[k]] = std::max(needed_[group[k]], more * work);
                learn(group[k], found[k].error, work);
            }
        }
    }

    void learn(std::size_t i, double error, double work)
    {
        seen_[i] = std::max(seen_[i], work);
        const double wanted = refinement_aim * quantities_[i].wanted;
        if (error > wanted)
            needed_[i] =
                std::max(needed_[i], std::min(work * std::pow(error / wanted, range_.samples_per_error), range_.most));
    }

    const MeasureSome& measure_;
    WorkRange range_;
    std::vector<WantedQuantity>& quantities_;
    std::vector<double> needed_, seen_;
};

} // namespace

void refine_by(const MeasureSome& measure, const WorkRange& range, std::vector<WantedQuantity>& quantities)
{
    Refinement(measure, range, quantities).run();
}

} // namespace lightwell
