#pragma once

#include <map>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace lightwell {

/// A difference between a file's truth and what we read that is meant to be, with its reason.
struct Deviation {
    std::string file, item, reason;
};

/// Collects what differs, file by file, and holds it to the list of what may differ.
class Deviations {
public:
    explicit Deviations(const std::vector<Deviation>& expected)
    {
        for (const Deviation& deviation : expected)
            expected_[{deviation.file, deviation.item}] = deviation.reason;
    }
    /// @param items  what differs in this file; empty: it agrees
    void file(const std::string& name, const std::set<std::string>& items)
    {
        ++(items.empty() ? agree_ : items.count("refused") > 0 ? refused_ : differ_);
        for (const std::string& item : items)
            if (expected_.erase({name, item}) == 0)
                surprises_.push_back(name + " differs in: " + item);
    }
    /// Prints the table.  @return what differs and should not, or should and does not
    std::vector<std::string> finish(std::ostream& out) const
    {
        out << agree_ + differ_ + refused_ << " files: " << agree_ << " agree, " << differ_ << " differ, " << refused_
            << " refused\n";
        std::vector<std::string> surprises = surprises_;
        for (const auto& [what, reason] : expected_)
            surprises.push_back(what.first + " no longer differs in: " + what.second);
        return surprises;
    }

private:
    std::map<std::pair<std::string, std::string>, std::string> expected_;
    std::vector<std::string> surprises_;
    std::size_t agree_ = 0, differ_ = 0, refused_ = 0;
};

} // namespace lightwell
