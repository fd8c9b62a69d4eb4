#include "importers/units.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <array>
#include <iterator>

namespace lightwell {
namespace {

struct NamedUnit {
    const char* name;
    double metres;
};

/// The first name of a length is the one that unit_name() gives back.
constexpr NamedUnit units[] = {
    {"mm", 1e-3},          {"millimetre", 1e-3},
    {"millimeter", 1e-3},  {"millimetres", 1e-3},
    {"millimeters", 1e-3}, {"cm", 1e-2},
    {"centimetre", 1e-2},  {"centimeter", 1e-2},
    {"centimetres", 1e-2}, {"centimeters", 1e-2},
    {"dm", 0.1},           {"decimetre", 0.1},
    {"decimeter", 0.1},    {"m", 1},
    {"metre", 1},          {"meter", 1},
    {"metres", 1},         {"meters", 1},
    {"dam", 10},           {"hm", 100},
    {"km", 1000},          {"kilometre", 1000},
    {"kilometer", 1000},   {"kilometres", 1000},
    {"kilometers", 1000},  {"in", 0.0254},
    {"inch", 0.0254},      {"inches", 0.0254},
    {"ft", 0.3048},        {"foot", 0.3048},
    {"feet", 0.3048},      {"yd", 0.9144},
    {"yard", 0.9144},      {"yards", 0.9144},
    {"mi", 1609.344},      {"mile", 1609.344},
    {"miles", 1609.344},   {"mil", 2.54e-5},
    {"um", 1e-6},          {"micron", 1e-6},
    {"nm", 1e-9},          {"us-ft", 1200. / 3937},
};

/// Metres of $INSUNITS 0 to 24; the last four are the US survey foot (1200/3937 m), inch, yard and mile.
constexpr std::array<double, 25> metres_of_insunits{0,
                                                    0.0254,
                                                    0.3048,
                                                    1609.344,
                                                    1e-3,
                                                    1e-2,
                                                    1,
                                                    1000,
                                                    2.54e-8,
                                                    2.54e-5,
                                                    0.9144,
                                                    1e-10,
                                                    1e-9,
                                                    1e-6,
                                                    0.1,
                                                    10,
                                                    100,
                                                    1e9,
                                                    1.495978707e11,
                                                    9.4607304725808e15,
                                                    3.0856775814913673e16,
                                                    1200. / 3937,
                                                    100. / 3937,
                                                    3600. / 3937,
                                                    6336000. / 3937};

std::string list_of_names()
{
    std::string list;
    double previous = 0;
    for (const NamedUnit& unit : units) {
        if (unit.metres != previous)
            list += (list.empty() ? "" : ", ") + std::string(unit.name);
        previous = unit.metres;
    }
    return list;
}

} // namespace

MetresPerUnit parse_unit(const std::string& name)
{
    const std::string word = lowercase_ascii(trimmed(name));
    for (const NamedUnit& unit : units)
        if (word == unit.name)
            return MetresPerUnit{unit.metres};
    const auto metres = parse_double(word);
    // Lengths of a light year and of an atom bound what a drawing unit can be.
    constexpr double smallest_m = 1e-12, largest_m = 1e18;
    if (metres && *metres >= smallest_m && *metres <= largest_m)
        return MetresPerUnit{*metres};
    throw InputError("unit \"" + name + '"', "is no unit of length",
                     "expected one of " + list_of_names() + " or the number of metres in one unit, such as 0.001");
}

MetresPerUnit unit_of_insunits(int code)
{
    return MetresPerUnit{
        code >= 0 && code < std::ssize(metres_of_insunits) ? metres_of_insunits[static_cast<std::size_t>(code)] : 0};
}

std::string unit_name(MetresPerUnit unit)
{
    for (const NamedUnit& known : units)
        if (known.metres == unit.value)
            return known.name;
    return shortest(unit.value);
}

Affine to_metres_z_up(MetresPerUnit unit, bool y_up)
{
    const Affine scaled = Affine::scale(unit.value);
    return y_up ? compose(Affine::rotate(0, pi / 2), scaled) : scaled;
}

} // namespace lightwell
