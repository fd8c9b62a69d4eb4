#include "plugins/commands/ies_opening.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lightwell::commands {
namespace {

using Shape = IesOpening::Shape;

/// What an opening without one of its sizes gets instead, and half of it where its height is 0.
constexpr double least_m = 0.001;

/// Sizes as written that are equal within rounding.
bool same(double a, double b)
{
    return std::fabs(a - b) < 1e-6;
}

IesOpening kept(Shape shape, const char* name)
{
    return {shape, name, {}, {}};
}

IesOpening elliptical(const char* name)
{
    return {Shape::disk, name, "a vertical elliptical cylinder", "circular cylinder"};
}

IesOpening box_for(const char* name, const char* replaced)
{
    return {Shape::rectangle, name, replaced, "box"};
}

/// Shapes that all editions know: points and what has corners.
std::optional<IesOpening> plain_opening(double w, double l, double h)
{
    if (w == 0 && l == 0 && h == 0)
        return kept(Shape::sphere, "point");
    if (w > 0 && l > 0 && h == 0)
        return kept(Shape::rectangle, "rectangle");
    if (w >= 0 && l >= 0 && w + l > 0 && h > 0)
        return kept(Shape::rectangle, "box");
    if (w < 0 && l == 0 && h == 0)
        return kept(Shape::disk, "disk");
    return std::nullopt;
}

std::optional<IesOpening> opening_before_2002(double w, double l, double h, bool edition_1995)
{
    if (w < 0 && l == 0 && h > 0)
        return kept(Shape::disk, "vertical cylinder");
    if (w == 0 && l > 0 && h < 0)
        return box_for("horizontal cylinder along photometric horizontal", "a horizontal cylinder");
    if (w > 0 && l == 0 && h < 0)
        return box_for("horizontal cylinder perpendicular to photometric horizontal", "a horizontal cylinder");
    if (edition_1995 && w * l < 0 && h > 0)
        return elliptical("vertical elliptical cylinder");
    if (edition_1995 && w * l < 0 && h < 0)
        return box_for("ellipsoid", "an ellipsoid");
    if (!edition_1995 && w < 0 && l > 0 && h == 0)
        return elliptical("ellipse");
    if (!edition_1995 && w < 0 && l > 0 && h > 0)
        return box_for("ellipsoid", "an ellipsoid");
    return std::nullopt;
}

std::optional<IesOpening> opening_of_2002(double w, double l, double h)
{
    const bool round = w < 0 && l < 0;
    if (round && h == 0)
        return same(w, l) ? kept(Shape::disk, "disk") : elliptical("ellipse");
    if (round && h > 0)
        return same(w, l) ? kept(Shape::disk, "vertical cylinder") : elliptical("vertical elliptical cylinder");
    if (round)
        return same(w, l) && same(l, h) ? kept(Shape::sphere, "sphere") : box_for("ellipsoid", "an ellipsoid");
    if (w < 0 && l > 0 && h < 0)
        return box_for(same(w, h) ? "horizontal cylinder along photometric horizontal"
                                  : "horizontal elliptical cylinder along photometric horizontal",
                       "a horizontal cylinder");
    if (w > 0 && l < 0 && h < 0)
        return box_for(same(l, h) ? "horizontal cylinder perpendicular to photometric horizontal"
                                  : "horizontal elliptical cylinder perpendicular to photometric horizontal",
                       "a horizontal cylinder");
    if (w == 0 && l < 0 && h < 0)
        return IesOpening{Shape::rectangle, "vertical ellipse facing photometric horizontal", "a vertical ellipse",
                          "rectangle"};
    return std::nullopt;
}

/// The edition of LM-63 that the first line names; files of 1986 name none.
int edition_of(const IesFile& file)
{
    const std::string first = file.label.empty() ? "" : file.label.front();
    if (first.rfind("IESNA91", 0) == 0)
        return 1991;
    if (first.rfind("IESNA:LM-63-", 0) != 0 && first.rfind("IES:LM-63-", 0) != 0)
        return 1986;
    return std::atoi(first.c_str() + first.find("-63-") + 4);
}

} // namespace

std::optional<IesOpening> ies_opening(const IesFile& file)
{
    const double w = file.width, l = file.length, h = file.height;
    const int edition = edition_of(file);
    auto opening = plain_opening(w, l, h);
    if (!opening)
        opening = edition >= 2002 ? opening_of_2002(w, l, h) : opening_before_2002(w, l, h, edition == 1995);
    if (!opening)
        return opening;
    const auto metres = [&](double size, double least) { return std::max(std::fabs(size) * file.metres, least); };
    opening->width_m = metres(w, least_m);
    opening->length_m = metres(l, least_m);
    opening->height_m = metres(h, least_m / 2);
    if (opening->shape == Shape::disk && edition >= 2002 && l != 0)
        opening->width_m = opening->length_m; // the width of an ellipse is not kept
    return opening;
}

} // namespace lightwell::commands
