#include "importers/generators/curve_functions.h"

#include <cmath>
#include <fmt/format.h>

namespace lightwell {
namespace {

using namespace generators;

constexpr const char* rev_usage = "Usage: genrev material name 'z(t)' 'r(t)' nseg [-e expr][-f file][-s]\n";
constexpr const char* worm_usage = "Usage: genworm material name 'x(t)' 'y(t)' 'z(t)' 'r(t)' nseg [-e expr][-f file]\n";
constexpr int most_segments = 1'000'000;

struct ProfilePoint {
    double z = 0, r = 0;
};

/// Of the surface that a step of the profile sweeps: outwards where z rises, inwards where it falls.
ProfilePoint normal_of(const ProfilePoint& from, const ProfilePoint& to)
{
    const double dz = to.z - from.z, dr = to.r - from.r, size = std::hypot(dz, dr);
    return size > 0 ? ProfilePoint{-dr / size, dz / size} : ProfilePoint{};
}

/// The bend of the normal at both ends of a segment as straight lines over height and radius, for rev.cal.
std::string smoothing(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& at_a, const ProfilePoint& at_b)
{
    const ProfilePoint flat = normal_of(a, b);
    const auto line = [](double x0, double x1, double y0, double y1) {
        const double slope = x1 != x0 ? (y1 - y0) / (x1 - x0) : 0;
        return std::pair(slope, x1 != x0 ? y0 - slope * x0 : (y0 + y1) / 2);
    };
    const auto [z_slope, z_offset] = line(a.z, b.z, at_a.z - flat.z, at_b.z - flat.z);
    const auto [r_slope, r_offset] = line(a.r, b.r, at_a.r - flat.r, at_b.r - flat.r);
    return fmt::format("{}{}{}{}\n", column(z_slope), column(z_offset), column(r_slope), column(r_offset));
}

void append_segment(std::string& text, const std::string& material, const std::string& name, const ProfilePoint& a,
                    const ProfilePoint& b)
{
    const Point from{0, 0, a.z}, to{0, 0, b.z};
    if (a.z == b.z)
        return append_round(text, material, "ring", name, {from, {0, 0, a.r < b.r ? -1.0 : 1.0}},
                            {std::fmin(a.r, b.r), std::fmax(a.r, b.r)});
    const bool outwards = a.z < b.z;
    if (a.r == b.r)
        return append_round(text, material, outwards ? "cylinder" : "tube", name, {from, to}, {a.r});
    append_round(text, material, outwards ? "cone" : "cup", name, {from, to}, {a.r, b.r});
}

/// Mean of the normals on both sides of a point of the profile.
ProfilePoint smooth_normal(const std::vector<ProfilePoint>& profile, std::size_t i)
{
    ProfilePoint sum;
    for (const std::size_t j : {i, i + 1}) {
        if (j == 0 || j >= profile.size())
            continue;
        const ProfilePoint n = normal_of(profile[j - 1], profile[j]);
        sum = {sum.z + n.z, sum.r + n.r};
    }
    const double size = std::hypot(sum.z, sum.r);
    return size > 0 ? ProfilePoint{sum.z / size, sum.r / size} : sum;
}

} // namespace

GeneratorAnswer genrev(const std::vector<std::string>& words, const GeneratorInput& input)
{
    return answered(words, rev_usage, [&](GeneratorAnswer& answer) {
        WordReader reader(words);
        CurveFunctions functions(input);
        const std::string material = reader.word("material"), name = reader.word("name");
        const std::string z = reader.word("z(t)"), r = reader.word("r(t)");
        const int segments = reader.count("number of segments", 1, most_segments);
        bool smooth = false;
        while (reader.more()) {
            const std::string option = reader.word("option");
            if (option == "-s")
                smooth = true;
            else if (!functions.option(option, reader))
                throw BadWords("Use error - unknown option: " + option);
        }
        functions.add("z`gen", "t", z);
        functions.add("r`gen", "t", r);
        functions.compile({"z`gen($1)", "r`gen($1)"});
        std::vector<ProfilePoint> profile;
        for (int i = 0; i <= segments; ++i) {
            const std::vector<double> value = functions.values({static_cast<double>(i) / segments});
            constexpr double nothing = 1e-10; // of what rounding leaves of zero
            profile.push_back({value[0], std::fabs(value[1]) < nothing ? 0 : std::fabs(value[1])});
        }
        answer.text = comment_of(words);
        for (std::size_t i = 1; i < profile.size(); ++i) {
            const ProfilePoint &a = profile[i - 1], &b = profile[i];
            if ((a.r == 0 && b.r == 0) || (a.z == b.z && a.r == b.r))
                continue;
            std::string modifier = material;
            if (smooth) {
                modifier = name + ".tex";
                answer.text += fmt::format("\nvoid texfunc {}\n4 rev_dx rev_dy rev_dz rev.cal\n0\n4", modifier) +
                               smoothing(a, b, smooth_normal(profile, i - 1), smooth_normal(profile, i));
                answer.text += fmt::format("\n{} alias {} {}\n", modifier, name + ".mat", material);
                modifier = name + ".mat";
            }
            append_segment(answer.text, modifier, fmt::format("{}.{}", name, i), a, b);
        }
    });
}

GeneratorAnswer genworm(const std::vector<std::string>& words, const GeneratorInput& input)
{
    return answered(words, worm_usage, [&](GeneratorAnswer& answer) {
        WordReader reader(words);
        CurveFunctions functions(input);
        const std::string material = reader.word("material"), name = reader.word("name");
        std::vector<std::string> calls;
        for (const char* what : {"x", "y", "z", "r"}) {
            functions.add(what + std::string("`gen"), "t", reader.word("x(t) y(t) z(t) r(t)"));
            calls.push_back(what + std::string("`gen($1)"));
        }
        const int segments = reader.count("number of segments", 1, most_segments);
        while (reader.more())
            if (const std::string option = reader.word("option"); !functions.option(option, reader))
                throw BadWords("Use error - unknown option: " + option);
        functions.compile(calls);
        answer.text = comment_of(words);
        std::vector<double> last;
        for (int i = 0; i <= segments; ++i) {
            const std::vector<double> at = functions.values({static_cast<double>(i) / segments});
            const Point centre{at[0], at[1], at[2]};
            if (!(at[3] >= 0))
                throw BadWords("the radius is negative");
            if (i > 0 && (at[3] > 0 || last[3] > 0)) {
                const Point before{last[0], last[1], last[2]};
                const std::string segment = fmt::format("{}.c{}", name, i);
                if (!(before == centre) && at[3] == last[3])
                    append_round(answer.text, material, "cylinder", segment, {before, centre}, {at[3]});
                else if (!(before == centre))
                    append_round(answer.text, material, "cone", segment, {before, centre}, {last[3], at[3]});
            }
            if (at[3] > 0)
                append_round(answer.text, material, "sphere", fmt::format("{}.s{}", name, i), {centre}, {at[3]});
            last = at;
        }
    });
}

} // namespace lightwell
