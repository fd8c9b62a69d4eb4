#include "engine/geometry/limit_surface.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/geometry/cage_faces.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <unordered_map>

namespace lightwell {
namespace {

/// An edge halved this often has a 4096th of its length; what still bends there is a tip of the surface.
constexpr int most_halvings = 12;
/// At least so many triangles a cage may become, however small it is: 100 MB at most.
constexpr std::size_t least_bound_on_triangles = std::size_t{1} << 20;
/// A large cage may become so many triangles for each of its faces.
constexpr std::size_t bound_for_each_face = 32;
/// Normals of neighbouring faces that differ by less than 1 degree belong to a smooth surface.
constexpr double smooth_cosine = 0.99985;
/// More points on one face, or faces at one point, are an error of the file rather than a design.
constexpr std::uint32_t most_corners_of_a_face = 1 << 14;

using PointId = std::uint32_t;
constexpr PointId no_point = std::numeric_limits<PointId>::max();

/// A triangle of one patch.
struct Piece {
    std::uint32_t face, patch;
    std::array<PointId, 3> points;
    std::array<FacePlace, 3> places;
    std::uint8_t halvings = 0;
    bool settled = false; ///< its middle was tried and lies near enough
};

std::uint64_t edge_key(PointId a, PointId b)
{
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

FacePlace between(const FacePlace& a, const FacePlace& b, double share)
{
    return {a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share};
}

double distance_to_line(const Point& p, const Point& a, const Point& b)
{
    const Vec3 along = b - a;
    const double squared = dot(along, along);
    const double share = squared > 0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0;
    return length(p - (a + along * share));
}

/// Halves the edges of triangles until their curves are near enough. Whether and where an edge is halved depends on
/// the edge alone, so both its triangles agree.
class Refinement {
public:
    Refinement(const SubdivisionCage& cage, CageFaces& faces, double tolerance_m);
    void run();
    void write(LimitSurface& result);

private:
    struct EdgeState {
        PointId middle = no_point; ///< no_point: near enough as it is
    };
    void add_face(std::uint32_t face, const std::uint32_t* corners, std::uint32_t size);
    PointId cage_point(std::uint32_t corner, std::size_t patch, const FacePlace& at);
    PointId middle_of(PointId a, PointId b, std::size_t patch, const FacePlace& at);
    void test_edges(const Piece& piece);
    void test_middle(Piece& piece);
    bool split(const Piece& piece, std::vector<Piece>& into) const;
    PointId middle_known(const Piece& piece, int edge) const;
    void choose(std::uint32_t face);

    const SubdivisionCage& cage_;
    CageFaces& faces_;
    const double tolerance_m_;
    std::size_t bound_;
    std::vector<PointId> point_of_cage_;
    std::vector<Point> points_;
    std::vector<Piece> pieces_;
    std::unordered_map<std::uint64_t, EdgeState> edges_;
    std::uint32_t chosen_ = std::numeric_limits<std::uint32_t>::max();
    double largest_deviation_m_ = 0; ///< of what is near enough
    double open_deviation_m_ = 0;    ///< of what was to be halved in the last pass
    bool reached_ = true;
};

Refinement::Refinement(const SubdivisionCage& cage, CageFaces& faces, double tolerance_m)
    : cage_(cage), faces_(faces), tolerance_m_(tolerance_m),
      bound_(std::max(least_bound_on_triangles, bound_for_each_face * cage.face_sizes.size())),
      point_of_cage_(cage.points.size(), no_point)
{
    std::size_t first = 0;
    for (std::uint32_t face = 0; face < cage.face_sizes.size(); ++face) {
        if (faces_.choose(face))
            add_face(face, &cage.corners[first], cage.face_sizes[face]);
        first += cage.face_sizes[face];
    }
}

PointId Refinement::cage_point(std::uint32_t corner, std::size_t patch, const FacePlace& at)
{
    PointId& point = point_of_cage_[corner];
    if (point == no_point) {
        point = static_cast<PointId>(points_.size());
        points_.push_back(faces_.point(patch, at));
    }
    return point;
}

PointId Refinement::middle_of(PointId a, PointId b, std::size_t patch, const FacePlace& at)
{
    EdgeState& edge = edges_[edge_key(a, b)];
    if (edge.middle == no_point) {
        edge.middle = static_cast<PointId>(points_.size());
        points_.push_back(faces_.point(patch, at));
    }
    return edge.middle;
}

/// Triangles around the middle of the face. No diagonals: two faces with the same corners would share them.
void Refinement::add_face(std::uint32_t face, const std::uint32_t* corners, std::uint32_t size)
{
    const auto add = [&](std::uint32_t patch, PointId a, PointId b, PointId c, const FacePlace& at_a,
                         const FacePlace& at_b, const FacePlace& at_c) {
        pieces_.push_back({face, patch, {a, b, c}, {at_a, at_b, at_c}, 0, false});
    };
    const auto middle = static_cast<PointId>(points_.size());
    points_.push_back(faces_.point(0, size == 4 ? FacePlace{0.5, 0.5} : FacePlace{1, 1}));
    for (std::uint32_t i = 0; i < size; ++i) {
        const std::uint32_t next = (i + 1) % size;
        if (size == 4) {
            constexpr std::array<FacePlace, 4> quad{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
            add(0, cage_point(corners[i], 0, quad[i]), cage_point(corners[next], 0, quad[next]), middle, quad[i],
                quad[next], {0.5, 0.5});
            continue;
        }
        const PointId from = cage_point(corners[i], i, {0, 0}), to = cage_point(corners[next], next, {0, 0});
        const PointId halfway = middle_of(from, to, i, {1, 0});
        add(i, from, halfway, middle, {0, 0}, {1, 0}, {1, 1});
        add(next, halfway, to, middle, {0, 1}, {0, 0}, {1, 1});
    }
}

void Refinement::choose(std::uint32_t face)
{
    if (chosen_ != face)
        faces_.choose(face);
    chosen_ = face;
}

void Refinement::test_edges(const Piece& piece)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const auto [entry, fresh] = edges_.try_emplace(edge_key(piece.points[i], piece.points[j]));
        if (!fresh)
            continue;
        choose(piece.face);
        const Point a = points_[piece.points[i]], b = points_[piece.points[j]];
        Point middle;
        double deviation_m = 0;
        for (const double share : {0.25, 0.5, 0.75}) {
            const Point p = faces_.point(piece.patch, between(piece.places[i], piece.places[j], share));
            deviation_m = std::fmax(deviation_m, distance_to_line(p, a, b));
            if (share == 0.5)
                middle = p;
        }
        if (!(deviation_m > tolerance_m_) || piece.halvings >= most_halvings) {
            largest_deviation_m_ = std::fmax(largest_deviation_m_, deviation_m);
            continue;
        }
        open_deviation_m_ = std::fmax(open_deviation_m_, deviation_m);
        entry->second.middle = static_cast<PointId>(points_.size());
        points_.push_back(middle);
    }
}

PointId Refinement::middle_known(const Piece& piece, int edge) const
{
    const auto found = edges_.find(
        edge_key(piece.points[static_cast<std::size_t>(edge)], piece.points[static_cast<std::size_t>((edge + 1) % 3)]));
    return found == edges_.end() ? no_point : found->second.middle;
}

/// A triangle may be far from the surface though its edges are near; then its longest edge is halved.
void Refinement::test_middle(Piece& piece)
{
    if (piece.settled)
        return;
    for (int edge = 0; edge < 3; ++edge)
        if (middle_known(piece, edge) != no_point)
            return;
    choose(piece.face);
    const Point &a = points_[piece.points[0]], &b = points_[piece.points[1]], &c = points_[piece.points[2]];
    const FacePlace at = between(between(piece.places[0], piece.places[1], 0.5), piece.places[2], 1.0 / 3);
    const Direction front = normalized(cross(b - a, c - a));
    const double deviation_m = std::fabs(dot(faces_.point(piece.patch, at) - a, front));
    piece.settled = !(deviation_m > tolerance_m_) || piece.halvings >= most_halvings;
    if (piece.settled) {
        largest_deviation_m_ = std::fmax(largest_deviation_m_, deviation_m);
        return;
    }
    open_deviation_m_ = std::fmax(open_deviation_m_, deviation_m);
    std::size_t longest = 0;
    const auto size = [&](std::size_t i) {
        return length(points_[piece.points[i]] - points_[piece.points[(i + 1) % 3]]);
    };
    for (std::size_t i = 1; i < 3; ++i)
        longest = size(i) > size(longest) ? i : longest;
    const std::size_t next = (longest + 1) % 3;
    middle_of(piece.points[longest], piece.points[next], piece.patch,
              between(piece.places[longest], piece.places[next], 0.5));
}

/// Puts the parts of a triangle, between the middles of its halved edges, in its place.
bool Refinement::split(const Piece& piece, std::vector<Piece>& into) const
{
    std::array<PointId, 6> points{};
    std::array<FacePlace, 6> places{};
    std::array<bool, 3> halved{};
    for (std::size_t i = 0; i < 3; ++i) {
        points[i] = piece.points[i];
        places[i] = piece.places[i];
        points[3 + i] = middle_known(piece, static_cast<int>(i));
        places[3 + i] = between(piece.places[i], piece.places[(i + 1) % 3], 0.5);
        halved[i] = points[3 + i] != no_point;
    }
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        into.push_back({piece.face,
                        piece.patch,
                        {points[a], points[b], points[c]},
                        {places[a], places[b], places[c]},
                        static_cast<std::uint8_t>(piece.halvings + 1),
                        false});
    };
    const auto count = std::count(halved.begin(), halved.end(), true);
    if (count == 0) {
        into.push_back(piece);
        return false;
    }
    if (count == 3) {
        add(0, 3, 5);
        add(3, 1, 4);
        add(5, 4, 2);
        add(3, 4, 5);
        return true;
    }
    // Turned so that with one halved edge it is the first, with two the whole one is the last.
    std::size_t k = 0;
    while (count == 1 ? !halved[k] : halved[(k + 2) % 3])
        ++k;
    const std::size_t a = k, b = (k + 1) % 3, c = (k + 2) % 3;
    if (count == 1) {
        add(a, 3 + a, c);
        add(3 + a, b, c);
        return true;
    }
    add(3 + a, b, 3 + b);
    const bool across =
        length(points_[points[3 + a]] - points_[points[c]]) < length(points_[points[a]] - points_[points[3 + b]]);
    if (across) {
        add(a, 3 + a, c);
        add(3 + a, 3 + b, c);
    } else {
        add(a, 3 + a, 3 + b);
        add(a, 3 + b, c);
    }
    return true;
}

void Refinement::run()
{
    for (bool changed = true; changed;) {
        open_deviation_m_ = 0;
        for (const Piece& piece : pieces_)
            test_edges(piece);
        for (Piece& piece : pieces_)
            test_middle(piece);
        changed = false;
        std::vector<Piece> next;
        next.reserve(pieces_.size());
        for (const Piece& piece : pieces_)
            changed = split(piece, next) || changed;
        pieces_ = std::move(next);
        if (changed && pieces_.size() > bound_) {
            // The halves of what was halved just now are nearer than the whole was; how near was not tried.
            reached_ = false;
            largest_deviation_m_ = std::fmax(largest_deviation_m_, open_deviation_m_);
            return;
        }
    }
}

/// Points become corners with one normal each; where the faces around a point have different normals it stands twice.
void Refinement::write(LimitSurface& result)
{
    Mesh& mesh = result.mesh;
    std::vector<PointId> next_of; // chain of the corners at the same point
    std::vector<PointId> first_of(points_.size(), no_point);
    const auto corner = [&](PointId point, const Direction& normal) {
        for (PointId known = first_of[point]; known != no_point; known = next_of[known])
            if (dot(mesh.normals[known], normal) > smooth_cosine)
                return known;
        const auto fresh = static_cast<PointId>(mesh.points.size());
        mesh.points.push_back(points_[point]);
        mesh.normals.push_back(normal);
        next_of.push_back(first_of[point]);
        first_of[point] = fresh;
        return fresh;
    };
    for (const Piece& piece : pieces_) {
        const Point &a = points_[piece.points[0]], &b = points_[piece.points[1]], &c = points_[piece.points[2]];
        const Direction flat = normalized(cross(b - a, c - a));
        if (flat == Vec3{})
            continue;
        choose(piece.face);
        for (std::size_t i = 0; i < 3; ++i) {
            const CageFaces::Sample sample = faces_.sample(piece.patch, piece.places[i]);
            const Direction normal = normalized(cross(sample.along_u, sample.along_v));
            mesh.triangles.push_back(corner(piece.points[i], normal == Vec3{} || !is_finite(normal) ? flat : normal));
        }
        result.faces.push_back(piece.face);
    }
    result.largest_deviation_m = largest_deviation_m_;
    result.reached_tolerance = reached_;
}

[[noreturn]] void reject(const std::string& place, const std::string& what)
{
    throw InputError{place, what, "the subdivision cage is damaged; export it again"};
}

void check_points(const SubdivisionCage& cage, const std::string& place)
{
    for (std::size_t i = 0; i < cage.points.size(); ++i)
        if (!is_finite(cage.points[i]))
            reject(place, "point " + std::to_string(i + 1) + " of the cage is not finite");
    const auto check = [&](std::uint32_t point, const std::string& who) {
        if (point >= cage.points.size())
            reject(place, who + " names point " + std::to_string(point) + " of " + std::to_string(cage.points.size()));
    };
    for (const std::uint32_t corner : cage.corners)
        check(corner, "a face");
    for (const SubdivisionCage::Tip& tip : cage.tips)
        check(tip.point, "a sharp point");
    const auto check_sharpness = [&](double sharpness) {
        if (!(sharpness >= 0))
            reject(place, "sharpness is " + shortest(sharpness) + ", expected >= 0");
    };
    for (const SubdivisionCage::Crease& crease : cage.creases)
        check_sharpness(crease.sharpness);
    for (const SubdivisionCage::Tip& tip : cage.tips)
        check_sharpness(tip.sharpness);
}

/// @throws InputError; past it the library may be trusted with the cage
void check_cage(const SubdivisionCage& cage, double chord_tolerance_m, const std::string& place)
{
    if (!(chord_tolerance_m > 0 && std::isfinite(chord_tolerance_m)))
        reject(place, "chord tolerance is " + shortest(chord_tolerance_m) + " m, expected > 0");
    std::size_t corners = 0;
    for (const std::uint32_t size : cage.face_sizes) {
        if (size < 3 || size > most_corners_of_a_face)
            reject(place, "a face of the cage has " + std::to_string(size) + " corners, expected 3 to " +
                              std::to_string(most_corners_of_a_face));
        corners += size;
    }
    if (corners != cage.corners.size())
        reject(place, "the faces of the cage have " + std::to_string(corners) + " corners together, but " +
                          std::to_string(cage.corners.size()) + " are listed");
    for (const std::uint32_t hole : cage.holes)
        if (hole >= cage.face_sizes.size())
            reject(place,
                   "a hole names face " + std::to_string(hole) + " of " + std::to_string(cage.face_sizes.size()));
    check_points(cage, place);
}

/// The cage without faces that name a point twice, which have no inside.
/// @param numbers  of the faces that are kept
SubdivisionCage without_collapsed_faces(const SubdivisionCage& cage, std::vector<std::uint32_t>& numbers)
{
    SubdivisionCage kept = cage;
    kept.face_sizes.clear();
    kept.corners.clear();
    kept.holes.clear();
    std::vector<bool> is_hole(cage.face_sizes.size(), false);
    for (const std::uint32_t hole : cage.holes)
        is_hole[hole] = true;
    std::size_t first = 0;
    for (std::uint32_t face = 0; face < cage.face_sizes.size(); ++face) {
        const std::uint32_t size = cage.face_sizes[face];
        const auto begin = cage.corners.begin() + static_cast<std::ptrdiff_t>(first);
        std::vector<std::uint32_t> sorted(begin, begin + size);
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) {
            if (is_hole[face])
                kept.holes.push_back(static_cast<std::uint32_t>(kept.face_sizes.size()));
            kept.face_sizes.push_back(size);
            kept.corners.insert(kept.corners.end(), begin, begin + size);
            numbers.push_back(face);
        }
        first += size;
    }
    return kept;
}

} // namespace

LimitSurface limit_surface(const SubdivisionCage& cage, double chord_tolerance_m, const std::string& place)
{
    check_cage(cage, chord_tolerance_m, place);
    LimitSurface result;
    std::vector<std::uint32_t> numbers;
    const SubdivisionCage good = without_collapsed_faces(cage, numbers);
    result.faces_left_out = cage.face_sizes.size() - numbers.size();
    if (good.face_sizes.empty())
        return result;
    CageFaces faces(good, place);
    result.creases_left_out = faces.creases_left_out();
    Refinement refinement(good, faces, chord_tolerance_m);
    refinement.run();
    refinement.write(result);
    for (std::uint32_t& face : result.faces)
        face = numbers[face];
    return result;
}

} // namespace lightwell
