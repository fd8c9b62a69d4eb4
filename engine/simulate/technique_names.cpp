#include "engine/simulate/technique_names.h"

#include "engine/base/errors.h"

#include <algorithm>

namespace lightwell {
namespace {

using T = Techniques;
using P = Preparation;
constexpr TechniqueName names[] = {
    {"ambient", "diffuse interreflection by scattered rays alone, as with --unbiased",
     [](T& t, P&) -> bool& { return t.deep_field; }},
    {"cache", "no records at the first surface: its ambient light by scattered rays",
     [](T& t, P&) -> bool& { return t.cache; }},
    {"gradients", "records are averaged as they are", [](T& t, P&) -> bool& { return t.gradients; }},
    {"hessian", "distance of records by the harmonic mean distance alone", [](T& t, P&) -> bool& { return t.hessian; }},
    {"image", "every pixel has paths of its own", [](T& t, P&) -> bool& { return t.image_sampling; }},
    {"adaptive", "every lamp and sun is tested", [](T&, P& p) -> bool& { return p.direct.adaptive; }},
    {"subdivision", "one shadow ray a source, however near", [](T&, P& p) -> bool& { return p.direct.subdivide; }},
    {"virtual", "light by way of mirrors by scattered rays alone", [](T&, P& p) -> bool& { return p.virtual_sources; }},
    {"secondary", "no rays are aimed at openings for what was scattered behind them",
     [](T&, P& p) -> bool& { return p.secondary.on; }},
    {"tree", "every lamp is looked at, however many", [](T&, P& p) -> bool& { return p.direct.tree; }},
    {"analytic", "no closed forms of near sources: samples alone", [](T&, P& p) -> bool& { return p.direct.analytic; }},
};

} // namespace

std::span<const TechniqueName> technique_names() noexcept
{
    return names;
}

void switch_off(const std::string& name, Techniques& techniques, Preparation& preparation)
{
    const auto found =
        std::find_if(std::begin(names), std::end(names), [&](const TechniqueName& n) { return n.name == name; });
    if (found != std::end(names)) {
        found->part(techniques, preparation) = false;
        return;
    }
    std::string known;
    for (const TechniqueName& n : names)
        known.append(known.empty() ? "" : ", ").append(n.name);
    throw InputError("--without", "\"" + name + "\" is no technique", "expected some of " + known);
}

std::string switched_off(Techniques techniques, Preparation preparation)
{
    std::string off;
    for (const TechniqueName& n : names)
        if (!n.part(techniques, preparation))
            off.append(off.empty() ? "" : ",").append(n.name);
    return off;
}

} // namespace lightwell
