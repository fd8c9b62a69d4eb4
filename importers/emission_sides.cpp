#include "importers/emission_sides.h"

#include "importers/round_outlines.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace lightwell {
namespace {

bool less(const Point& a, const Point& b)
{
    return PointOrder{}(a, b);
}

bool is_part_of_round(const Part& part, const Surface& surface)
{
    return !sector_of(part, surface).is_whole();
}

/// An edge without direction; corners are equal when their coordinates are.
struct Edge {
    Point low, high;
    bool operator<(const Edge& other) const { return low == other.low ? less(high, other.high) : less(low, other.low); }
};

/// Who uses an edge, and how often more in the one direction than in the other.
struct EdgeUse {
    std::size_t first_user = 0;
    long balance = 0;
};

/// The outlines of a polygon, of each triangle of a mesh, of each of so many pieces of part of a round shape.
template <class Visit>
void visit_outlines(const Part& part, const Surface& surface, int pieces, const Visit& visit)
{
    for (int i = 0; is_part_of_round(part, surface) && i < pieces; ++i) {
        const std::vector<Point> corners =
            outline_of_round(part, surface, static_cast<double>(i) / pieces, (i + 1.0) / pieces);
        visit(corners.data(), corners.size());
    }
    if (surface.shape == Shape::polygon) {
        const Polygon& polygon = part.polygons[surface.index];
        visit(&part.points[polygon.first], polygon.count);
    } else if (surface.shape == Shape::mesh) {
        const Mesh& mesh = *part.meshes[surface.index];
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            const std::array<Point, 3> corners{mesh.points[mesh.triangles[i]], mesh.points[mesh.triangles[i + 1]],
                                               mesh.points[mesh.triangles[i + 2]]};
            visit(corners.data(), corners.size());
        }
    }
}

/// Groups of surfaces that hang together by their edges.
class Components {
public:
    explicit Components(std::size_t count) : parent_(count)
    {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t root(std::size_t i)
    {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

private:
    std::vector<std::size_t> parent_;
};

struct Body {
    bool closed = true;
    bool any = false;
    Point reference;
    double volume_m3 = 0; ///< positive when the fronts look outwards
};

/// Six times the volume between an outline and a point is dot(corner - point, 2 * area vector) for a plane outline.
void add_volume(Body& body, const Point* corners, std::size_t count)
{
    if (!body.any)
        body.reference = corners[0];
    body.any = true;
    body.volume_m3 += dot(corners[0] - body.reference, polygon_area_vector(corners, count)) / 3;
}

/// The edges of the emitters and how they hang together. Arcs count as the chord between their ends.
std::map<Edge, EdgeUse> find_edges(const Part& part, const std::vector<std::size_t>& emitters, Components& components)
{
    // Straight outlines first: the corners of round parts then find theirs.
    const bool any_round = std::any_of(emitters.begin(), emitters.end(),
                                       [&](std::size_t e) { return is_part_of_round(part, part.surfaces[e]); });
    SharedCorners corners_of_all;
    std::map<Edge, EdgeUse> edges;
    for (const bool round : {false, true})
        for (std::size_t e = 0; e < emitters.size(); ++e) {
            const Surface& surface = part.surfaces[emitters[e]];
            if (is_part_of_round(part, surface) != round)
                continue;
            visit_outlines(part, surface, 1, [&](const Point* corners, std::size_t count) {
                for (std::size_t i = 0; i < count; ++i) {
                    Point a = corners[i], b = corners[(i + 1) % count];
                    if (round) {
                        a = corners_of_all.shared(a);
                        b = corners_of_all.shared(b);
                    } else if (any_round) {
                        corners_of_all.add(a);
                    }
                    if (round && a == b)
                        continue; // the tip of a cone
                    const bool forward = less(a, b);
                    const auto [use, fresh] = edges.try_emplace(forward ? Edge{a, b} : Edge{b, a}, EdgeUse{e, 0});
                    use->second.balance += forward ? 1 : -1;
                    components.join(e, use->second.first_user);
                }
            });
        }
    return edges;
}

/// Bodies of the emitters' polygons, meshes and parts of round shapes; body_of[i] belongs to emitters[i].
std::vector<Body> find_bodies(const Part& part, const std::vector<std::size_t>& emitters,
                              std::vector<std::size_t>& body_of)
{
    constexpr int pieces = 16; // of a turn at most: enough to tell inside from outside
    Components components{emitters.size()};
    const std::map<Edge, EdgeUse> edges = find_edges(part, emitters, components);
    std::vector<Body> bodies(emitters.size());
    body_of.resize(emitters.size());
    for (std::size_t e = 0; e < emitters.size(); ++e) {
        body_of[e] = components.root(e);
        visit_outlines(part, part.surfaces[emitters[e]], pieces, [&](const Point* corners, std::size_t count) {
            add_volume(bodies[body_of[e]], corners, count);
        });
    }
    for (const auto& [edge, use] : edges)
        if (use.balance != 0)
            bodies[components.root(use.first_user)].closed = false;
    return bodies;
}

/// A ring that closes the end of an emitting cone or cylinder looks away from the body.
bool closes_a_cone(const Part& part, const std::vector<std::size_t>& emitters, const Ring& ring, Turn& turn)
{
    // Ends and radii come from the same numbers of the file, rounded once or twice on the way.
    constexpr double same_relative = 1e-9;
    for (const std::size_t other : emitters) {
        const Shape shape = part.surfaces[other].shape;
        if (shape != Shape::cone && shape != Shape::cylinder && shape != Shape::cup && shape != Shape::tube)
            continue;
        const Cone& cone = part.cones[part.surfaces[other].index];
        const double near = same_relative * (length(cone.ends[1] - cone.ends[0]) + ring.outer_radius);
        for (int end = 0; end < 2; ++end) {
            if (length(cone.ends[end] - ring.centre) > near || std::fabs(cone.radii[end] - ring.outer_radius) > near)
                continue;
            turn = dot(ring.normal, cone.ends[end] - cone.ends[1 - end]) > 0 ? Turn::as_is : Turn::reversed;
            return true;
        }
    }
    return false;
}

std::shared_ptr<const Mesh> reversed_mesh(const Mesh& mesh)
{
    auto copy = std::make_shared<Mesh>(mesh);
    for (std::size_t i = 0; i + 2 < copy->triangles.size(); i += 3)
        std::swap(copy->triangles[i + 1], copy->triangles[i + 2]);
    for (Direction& normal : copy->normals)
        normal = -normal;
    return copy;
}

Shape inside_out(Shape shape)
{
    switch (shape) {
    case Shape::sphere:
        return Shape::bubble;
    case Shape::bubble:
        return Shape::sphere;
    case Shape::cone:
        return Shape::cup;
    case Shape::cup:
        return Shape::cone;
    case Shape::cylinder:
        return Shape::tube;
    case Shape::tube:
        return Shape::cylinder;
    default:
        return shape;
    }
}

} // namespace

std::vector<Turn> emission_turns(const Part& part, const std::vector<std::size_t>& emitters, EmissionSide side)
{
    const Turn open = side == EmissionSide::both    ? Turn::both
                      : side == EmissionSide::front ? Turn::as_is
                                                    : Turn::reversed;
    std::vector<std::size_t> body_of;
    const std::vector<Body> bodies = find_bodies(part, emitters, body_of);
    std::vector<Turn> turns(emitters.size(), Turn::as_is);
    for (std::size_t e = 0; e < emitters.size(); ++e) {
        const Surface& surface = part.surfaces[emitters[e]];
        const Body& body = bodies[body_of[e]];
        if (surface.shape == Shape::polygon || surface.shape == Shape::mesh || is_part_of_round(part, surface)) {
            turns[e] = !body.closed ? open : body.volume_m3 < 0 ? Turn::reversed : Turn::as_is;
            continue;
        }
        switch (surface.shape) {
        case Shape::ring:
            if (!closes_a_cone(part, emitters, part.rings[surface.index], turns[e]))
                turns[e] = open;
            break;
        case Shape::bubble:
        case Shape::cup:
        case Shape::tube:
            turns[e] = Turn::reversed;
            break;
        case Shape::polygon:
        case Shape::mesh:
        case Shape::sphere:
        case Shape::cone:
        case Shape::cylinder:
        case Shape::source:
        case Shape::instance:
            break;
        }
    }
    return turns;
}

void append_copy(Part& to, const Part& from, const Surface& surface, bool reversed, ModifierId modifier,
                 std::string name)
{
    const Shape shape = reversed ? inside_out(surface.shape) : surface.shape;
    switch (surface.shape) {
    case Shape::polygon: {
        const Polygon& polygon = from.polygons[surface.index];
        const auto first = from.points.begin() + polygon.first;
        std::vector<Point> corners(first, first + polygon.count);
        if (reversed)
            std::reverse(corners.begin(), corners.end());
        to.add_polygon(corners, modifier, std::move(name));
        break;
    }
    case Shape::sphere:
    case Shape::bubble:
        to.add_sphere(from.spheres[surface.index], shape, modifier, std::move(name));
        break;
    case Shape::cone:
    case Shape::cup:
    case Shape::cylinder:
    case Shape::tube:
        to.add_cone(from.cones[surface.index], shape, modifier, std::move(name));
        break;
    case Shape::ring: {
        Ring ring = from.rings[surface.index];
        if (reversed) {
            ring.sector = turned_over(ring.sector, ring.normal);
            ring.normal = -ring.normal;
        }
        to.add_ring(ring, modifier, std::move(name));
        break;
    }
    case Shape::mesh: {
        const auto& mesh = from.meshes[surface.index];
        to.add_mesh(reversed ? reversed_mesh(*mesh) : mesh, modifier, std::move(name));
        break;
    }
    case Shape::source:
        to.add_source(from.sources[surface.index], modifier, std::move(name));
        break;
    case Shape::instance:
        break;
    }
}

} // namespace lightwell
