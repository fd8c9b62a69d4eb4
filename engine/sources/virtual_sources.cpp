#include "engine/sources/virtual_sources.h"

#include "engine/base/errors.h"

#include <algorithm>
#include <string>
#include <tuple>

namespace lightwell {
namespace {

/// Roundings in the comparison of angles; it may only err on the side of keeping.
constexpr double angle_slack = 1e-9;

Affine reflection(const PlanarMirror& mirror)
{
    const Direction& n = mirror.frame.z;
    return {Vec3{1, 0, 0} - n * (2 * n.x), Vec3{0, 1, 0} - n * (2 * n.y), Vec3{0, 0, 1} - n * (2 * n.z),
            n * (2 * dot(n, mirror.centre))};
}

/// A ball, or a distant disc, as seen from a point: every direction that meets it lies within an angle of its middle.
struct SeenCone {
    Direction middle{0, 0, 1};
    double sine = 1, cosine = 0; ///< of the angle
    bool everywhere = true;      ///< the point is inside the ball

    SeenCone() = default;
    SeenCone(const Direction& direction, double sin_half)
        : middle(direction), sine(sin_half), cosine(std::sqrt(std::fmax(0, 1 - sin_half * sin_half))), everywhere(false)
    {
    }
    SeenCone(const Point& from, const Point& centre, double radius_m)
    {
        const Vec3 way = centre - from;
        const double distance = length(way);
        if (distance > radius_m)
            *this = SeenCone(way / distance, radius_m / distance);
    }
    bool meets(const SeenCone& other) const
    {
        return everywhere || other.everywhere ||
               dot(middle, other.middle) >= cosine * other.cosine - sine * other.sine - angle_slack;
    }
};

struct Extent {
    double low = infinity, high = -infinity;
};

/// Heights of a mirror over the plane of another.
Extent extent_over(const PlanarMirror& plane, const PlanarMirror& mirror)
{
    Extent extent;
    const double middle = plane.height_m(mirror.centre);
    if (mirror.outline.edges.empty()) {
        const double reach = mirror.radius_m * length(cross(plane.frame.z, mirror.frame.z));
        return {middle - reach, middle + reach};
    }
    const double slope_x = dot(plane.frame.z, mirror.frame.x), slope_y = dot(plane.frame.z, mirror.frame.y);
    for (const FlatOutline::Edge& edge : mirror.outline.edges) {
        const double height = middle + slope_x * edge.ax + slope_y * edge.ay;
        extent.low = std::fmin(extent.low, height);
        extent.high = std::fmax(extent.high, height);
    }
    return extent;
}

} // namespace

/// Images level by level: those of the sources, then those of images.
struct VirtualSources::Builder {
    VirtualSources& made;
    const VirtualSettings& settings;

    struct Draft {
        MirrorRoute route;
        VirtualSource image;
        double score;       ///< flux that the last mirror sends on, roughly, W
        std::size_t number; ///< order of making, for equal scores
    };
    std::vector<Draft> level = {}, all = {};
    std::size_t number = 0;

    const std::vector<PlanarMirror>& mirrors() const { return made.mirrors_.mirrors(); }

    void keep_strongest(std::vector<Draft>& drafts)
    {
        std::sort(drafts.begin(), drafts.end(), [](const Draft& a, const Draft& b) {
            return std::tie(b.score, a.number) < std::tie(a.score, b.number);
        });
        if (drafts.size() > settings.most_images) {
            made.left_out_ += drafts.size() - settings.most_images;
            drafts.resize(settings.most_images);
        }
    }
    void keep(std::vector<Draft>& drafts, Draft draft)
    {
        if (!(draft.score > 0))
            return;
        draft.number = number++;
        drafts.push_back(std::move(draft));
        if (drafts.size() >= 4 * settings.most_images + 64) // so that lamps times mirrors need no memory
            keep_strongest(drafts);
    }

    /// What stands before a mirror, seen in it as well.
    Draft mirrored(const Draft& before, std::size_t index) const
    {
        const PlanarMirror& mirror = mirrors()[index];
        Draft draft = before;
        MirrorRoute& route = draft.route;
        route.reflections = {};
        route.reflections.add(static_cast<int>(index));
        route.mirrors[0] = {mirror.centre, mirror.radius_m};
        for (int i = 0; i < before.route.reflections.count; ++i) {
            const auto at = static_cast<std::size_t>(i);
            route.reflections.add(before.route.reflections.mirrors[at]);
            const Ball& ball = before.route.mirrors[at];
            route.mirrors[at + 1] = {mirror.reflect(ball.centre), ball.radius_m};
        }
        route.unfold = compose(before.route.unfold, reflection(mirror));
        route.reflectance = before.route.reflectance * mirror.reflectance;
        draft.image.ball.centre = mirror.reflect(before.image.ball.centre);
        draft.image.to_sun = mirror.reflect_vector(before.image.to_sun);
        return draft;
    }

    void first_level()
    {
        Draft plain{};
        plain.route.reflectance = Spectrum::grey(1);
        for (std::size_t i = 0; i < made.sources_.suns().size(); ++i) {
            const SunSource& sun = made.sources_.suns()[i];
            const double half = 0.5 * sun.disc.full_angle_deg * radians_per_degree;
            plain.image = {0, static_cast<std::uint32_t>(i), true, {}, sun.disc.to_source, std::sin(half)};
            const double beam = photopic(sun.radiance) * cone_solid_angle_sr(half);
            for (std::size_t m = 0; m < mirrors().size(); ++m) {
                Draft draft = mirrored(plain, m);
                draft.score = beam * mirrors()[m].area_m2 * photopic(draft.route.reflectance);
                keep(level, std::move(draft));
            }
        }
        for (std::size_t i = 0; i < made.sources_.lamps().size(); ++i) {
            const LocalSource& lamp = made.sources_.lamps()[i];
            plain.image = {0, static_cast<std::uint32_t>(i), false, {lamp.centre(), lamp.radius_m()}, {}, 0};
            for (std::size_t m = 0; m < mirrors().size(); ++m) {
                Draft draft = mirrored(plain, m);
                draft.score = lamp_score(lamp, mirrors()[m]) * photopic(draft.route.reflectance);
                keep(level, std::move(draft));
            }
        }
        keep_strongest(level);
    }
    /// A mirror behind a flat lamp in its middle may still have a part before it: such lamps get a small score, never
    /// 0.
    static double lamp_score(const LocalSource& lamp, const PlanarMirror& mirror)
    {
        constexpr double behind = 1e-6;
        const double strength = photopic(emitted_radiance(lamp.material()));
        return mirror.area_m2 * std::fmax(lamp.potential(mirror.centre, mirror.frame.z, true), behind * strength);
    }

    /// Whether light of an image that its last mirror A has sent on may meet mirror B.
    bool meets(const Draft& draft, std::size_t index) const
    {
        const auto last = static_cast<std::size_t>(draft.route.reflections.mirrors[0]);
        if (index == last)
            return false;
        const PlanarMirror &a = mirrors()[last], &b = mirrors()[index];
        const VirtualSource& image = draft.image;
        const Extent b_over_a = extent_over(a, b), a_over_b = extent_over(b, a);
        if (!(a_over_b.high > a.error_m + b.error_m || a_over_b.low < -(a.error_m + b.error_m)))
            return false; // both in one plane
        // The image stands behind A: light goes on to the other side.
        const double height = image.is_sun ? dot(a.frame.z, image.to_sun) : a.height_m(image.ball.centre);
        const double reach = image.is_sun ? image.sin_half : image.ball.radius_m;
        if ((height > reach && !(b_over_a.low < 0)) || (height < -reach && !(b_over_a.high > 0)))
            return false;
        const SeenCone onward(a.centre, b.centre, a.radius_m + b.radius_m);
        if (image.is_sun)
            return onward.meets(SeenCone(-image.to_sun, image.sin_half));
        const SeenCone arriving(image.ball.centre, a.centre, image.ball.radius_m + a.radius_m);
        return onward.meets(arriving);
    }

    void next_level()
    {
        std::vector<Draft> next;
        for (const Draft& draft : level)
            for (std::size_t m = 0; m < mirrors().size(); ++m) {
                if (!meets(draft, m))
                    continue;
                Draft further = mirrored(draft, m);
                const auto last = static_cast<std::size_t>(draft.route.reflections.mirrors[0]);
                further.score *=
                    photopic(mirrors()[m].reflectance) * std::fmin(1, mirrors()[m].area_m2 / mirrors()[last].area_m2);
                keep(next, std::move(further));
            }
        keep_strongest(next);
        level = std::move(next);
    }

    void finish()
    {
        keep_strongest(all);
        std::sort(all.begin(), all.end(), [](const Draft& a, const Draft& b) {
            if (a.route.reflections < b.route.reflections || b.route.reflections < a.route.reflections)
                return a.route.reflections < b.route.reflections;
            return std::tie(b.image.is_sun, a.image.source) < std::tie(a.image.is_sun, b.image.source);
        });
        for (Draft& draft : all) {
            if (made.routes_.empty() || !(made.routes_.back().reflections == draft.route.reflections)) {
                draft.route.first_image = static_cast<std::uint32_t>(made.images_.size());
                made.route_by_reflections_[draft.route.reflections] = static_cast<std::uint32_t>(made.routes_.size());
                made.routes_.push_back(draft.route);
            }
            draft.image.route = static_cast<std::uint32_t>(made.routes_.size() - 1);
            made.images_.push_back(draft.image);
            made.routes_.back().end_image = static_cast<std::uint32_t>(made.images_.size());
        }
    }
    void run()
    {
        if (mirrors().empty())
            return;
        first_level();
        for (int depth = 1; !level.empty(); ++depth) {
            all.insert(all.end(), level.begin(), level.end());
            if (depth >= settings.depth)
                break;
            next_level();
        }
        finish();
    }
};

VirtualSources::VirtualSources(const Scene& scene, const SourceList& sources, const VirtualSettings& settings)
    : sources_(sources)
{
    if (!(settings.depth >= 0 && settings.depth <= Reflections::most))
        throw InputError{"virtual sources",
                         "depth is " + std::to_string(settings.depth) + ", expected 0 to " +
                             std::to_string(Reflections::most),
                         "mirrors beyond it are followed by scattered rays"};
    if (settings.depth == 0 || settings.most_images == 0 || (sources.suns().empty() && sources.lamps().empty()))
        return;
    mirrors_ = MirrorSet(scene);
    Builder{*this, settings}.run();
}

void VirtualSources::candidates(const Receiver& receiver, bool lamps, bool suns, std::vector<Candidate>& found) const
{
    found.clear();
    for (const MirrorRoute& route : routes_) {
        const Ball& nearest = route.mirrors[0];
        if (!receiver.transmits && !(dot(receiver.normal, nearest.centre - receiver.at) > -nearest.radius_m))
            continue;
        for (std::uint32_t i = route.first_image; i < route.end_image; ++i)
            if (images_[i].is_sun ? suns : lamps)
                if (const double value = potential(images_[i], receiver); value > 0)
                    found.push_back({i, value});
    }
}

/// Whether a point may lie in the volume of an image: before the nearest mirror, and in line with it and all mirrors.
bool VirtualSources::may_see(const VirtualSource& image, const Point& from) const noexcept
{
    const MirrorRoute& route = routes_[image.route];
    const PlanarMirror& nearest = mirrors_.mirrors()[static_cast<std::size_t>(route.reflections.mirrors[0])];
    // What is seen in a mirror seems to stand behind it.
    const double behind = image.is_sun ? dot(nearest.frame.z, image.to_sun) : nearest.height_m(image.ball.centre);
    const double reach = image.is_sun ? image.sin_half : image.ball.radius_m;
    const double before = nearest.height_m(from);
    if ((before > 0 && behind > reach) || (before < 0 && behind < -reach))
        return false;
    const SeenCone seen =
        image.is_sun ? SeenCone(image.to_sun, image.sin_half) : SeenCone(from, image.ball.centre, image.ball.radius_m);
    for (int i = 0; i < route.reflections.count; ++i) {
        const Ball& ball = route.mirrors[static_cast<std::size_t>(i)];
        if (!SeenCone(from, ball.centre, ball.radius_m).meets(seen))
            return false;
    }
    return true;
}

double VirtualSources::potential(const VirtualSource& image, const Receiver& receiver) const noexcept
{
    if (!may_see(image, receiver.at))
        return 0;
    const MirrorRoute& route = routes_[image.route];
    const double reflected = photopic(route.reflectance);
    if (!image.is_sun)
        return reflected * sources_.lamps()[image.source].potential(route.unfold.point(receiver.at),
                                                                    route.unfold.vector(receiver.normal),
                                                                    receiver.transmits);
    const double cosine = dot(receiver.normal, image.to_sun);
    const double arriving = std::fmin(1, (receiver.transmits ? std::fabs(cosine) : cosine) + image.sin_half);
    const SunSource& sun = sources_.suns()[image.source];
    return std::fmax(0, arriving) * reflected * photopic(sun.radiance) *
           cone_solid_angle_sr(0.5 * sun.disc.full_angle_deg * radians_per_degree);
}

int VirtualSources::image_of(const Reflections& reflections, bool is_sun, int source) const noexcept
{
    const auto found = route_by_reflections_.find(reflections);
    if (found == route_by_reflections_.end())
        return -1;
    const MirrorRoute& route = routes_[found->second];
    const auto wanted = std::make_pair(!is_sun, static_cast<std::uint32_t>(source));
    const auto begin = images_.begin() + route.first_image, end = images_.begin() + route.end_image;
    const auto at = std::lower_bound(begin, end, wanted, [](const VirtualSource& image, const auto& value) {
        return std::make_pair(!image.is_sun, image.source) < value;
    });
    if (at == end || at->is_sun != is_sun || at->source != static_cast<std::uint32_t>(source))
        return -1;
    return static_cast<int>(at - images_.begin());
}

} // namespace lightwell
