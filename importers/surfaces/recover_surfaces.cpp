#include "importers/surfaces/recover_surfaces.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/surfaces/split_creases.h"
#include "importers/surfaces/triangle_pool.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

namespace lightwell {
namespace {

/// A mesh of which fewer triangles become polygons is a curved shape: it stays whole, as one mesh is faster to trace.
constexpr double least_share_in_polygons = 0.5;
/// Larger parts are scans and terrains; they stay triangles (a note says so).
constexpr std::size_t most_triangles = 2'000'000;
constexpr std::uint32_t no_group = std::numeric_limits<std::uint32_t>::max();

/// What may be joined: by key where the ledger counts by key, else by key and name. Surfaces that are no plain
/// triangles have no group, nor have triangles that are alone in theirs.
std::vector<std::uint32_t> groups_of(const Part& part, const Imported& imported)
{
    const std::size_t counted_by_key = imported.made_with_key.size();
    std::unordered_map<std::string, std::uint32_t> numbers; // by modifier and name
    std::vector<std::uint32_t> groups(part.surfaces.size(), no_group);
    std::vector<std::size_t> triangles(counted_by_key, 0); // by group
    for (std::size_t i = 0; i < part.surfaces.size(); ++i) {
        const Surface& surface = part.surfaces[i];
        if (!is_plain_triangles(part, surface) || surface.modifier < 0)
            continue;
        if (static_cast<std::size_t>(surface.modifier) < counted_by_key) {
            groups[i] = static_cast<std::uint32_t>(surface.modifier);
        } else {
            const auto next = static_cast<std::uint32_t>(triangles.size());
            groups[i] = numbers.try_emplace(std::to_string(surface.modifier).append(":").append(surface.name), next)
                            .first->second;
            triangles.resize(counted_by_key + numbers.size(), 0);
        }
        triangles[groups[i]] += triangle_count(part, surface);
    }
    for (std::uint32_t& group : groups)
        if (group != no_group && triangles[group] < 2)
            group = no_group;
    return groups;
}

/// Puts polygons in the place of the triangles of one part.
class PartRecovery {
public:
    PartRecovery(Part& part, const std::vector<std::uint32_t>& groups) : part_(part), groups_(groups) {}
    /// @return number of polygons made
    std::size_t run();

private:
    void join();
    bool hold_curved_meshes();
    void rebuild();
    void add_rest(const Surface& surface, std::uint32_t index, Part& to) const;

    Part& part_;
    const std::vector<std::uint32_t>& groups_;
    std::vector<bool> joined_; ///< by surface
    std::optional<TrianglePool> pool_;
    std::vector<FlatFace> faces_;
    std::vector<bool> used_;                       ///< by triangle of the soup: part of a face
    std::vector<std::vector<std::size_t>> first_;  ///< by surface: faces that take its place
    std::vector<std::size_t> used_of_surface_;     ///< by surface: its triangles in faces
    std::vector<std::vector<std::uint32_t>> rest_; ///< by surface: its triangles in no face
};

void PartRecovery::join()
{
    pool_.emplace(part_, joined_, groups_);
    faces_ = merge_coplanar(pool_->soup());
    used_.assign(pool_->soup().triangles.size(), false);
    used_of_surface_.assign(part_.surfaces.size(), 0);
    for (const FlatFace& face : faces_)
        for (const std::uint32_t triangle : face.triangles) {
            used_[triangle] = true;
            ++used_of_surface_[pool_->surface_of(triangle)];
        }
}

/// @return true when there are such meshes, and the joining must be done again without them
bool PartRecovery::hold_curved_meshes()
{
    bool any = false;
    for (std::size_t i = 0; i < part_.surfaces.size(); ++i) {
        const Surface& surface = part_.surfaces[i];
        if (!joined_[i] || surface.shape != Shape::mesh)
            continue;
        const auto triangles = static_cast<double>(triangle_count(part_, surface));
        if (static_cast<double>(used_of_surface_[i]) < least_share_in_polygons * triangles) {
            joined_[i] = false;
            any = true;
        }
    }
    return any;
}

void PartRecovery::add_rest(const Surface& surface, std::uint32_t index, Part& to) const
{
    if (rest_[index].empty())
        return;
    const TriangleSoup& soup = pool_->soup();
    Mesh mesh;
    std::map<std::uint32_t, std::uint32_t> moved;
    for (const std::uint32_t triangle : rest_[index])
        for (const std::uint32_t point : soup.triangles[triangle]) {
            const auto [entry, fresh] = moved.try_emplace(point, static_cast<std::uint32_t>(mesh.points.size()));
            if (fresh)
                mesh.points.push_back(soup.points[point]);
            mesh.triangles.push_back(entry->second);
        }
    if (surface.shape == Shape::polygon || mesh.triangles.size() == 3)
        to.add_polygon({mesh.points[mesh.triangles[0]], mesh.points[mesh.triangles[1]], mesh.points[mesh.triangles[2]]},
                       surface.modifier, surface.name);
    else
        to.add_mesh(std::make_shared<const Mesh>(std::move(mesh)), surface.modifier, surface.name);
}

/// Everything in the order of the file; a polygon stands where the first of its triangles stood.
void PartRecovery::rebuild()
{
    first_.assign(part_.surfaces.size(), {});
    rest_.assign(part_.surfaces.size(), {});
    for (std::size_t i = 0; i < faces_.size(); ++i)
        first_[pool_->surface_of(faces_[i].triangles.front())].push_back(i);
    for (std::uint32_t triangle = 0; triangle < used_.size(); ++triangle)
        if (!used_[triangle])
            rest_[pool_->surface_of(triangle)].push_back(triangle);
    Part next = std::move(part_);
    const std::vector<Surface> surfaces = std::move(next.surfaces);
    const std::vector<Point> points = std::move(next.points);
    const std::vector<Polygon> polygons = std::move(next.polygons);
    const std::vector<std::shared_ptr<const Mesh>> meshes = std::move(next.meshes);
    next.surfaces.clear();
    next.points.clear();
    next.polygons.clear();
    next.meshes.clear();
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
        const Surface& surface = surfaces[i];
        for (const std::size_t face : first_[i]) {
            std::vector<std::vector<Point>> holes;
            for (const auto& hole : faces_[face].holes)
                holes.push_back(pool_->points_of(hole));
            next.add_polygon_with_holes(pool_->points_of(faces_[face].outline), holes, surface.modifier, surface.name);
        }
        if (joined_[i]) {
            add_rest(surface, i, next);
        } else if (surface.shape == Shape::polygon) {
            const auto begin = points.begin() + polygons[surface.index].first;
            next.add_polygon({begin, begin + polygons[surface.index].count}, surface.modifier, surface.name);
        } else if (surface.shape == Shape::mesh) {
            next.add_mesh(meshes[surface.index], surface.modifier, surface.name);
        } else {
            next.surfaces.push_back(surface);
        }
    }
    part_ = std::move(next);
}

std::size_t PartRecovery::run()
{
    for (const std::uint32_t group : groups_)
        joined_.push_back(group != no_group);
    if (std::find(joined_.begin(), joined_.end(), true) == joined_.end())
        return 0;
    join();
    while (hold_curved_meshes())
        join();
    if (!faces_.empty())
        rebuild();
    return faces_.size();
}

std::size_t plain_triangles(const Part& part)
{
    std::size_t count = 0;
    for (const Surface& surface : part.surfaces)
        count += is_plain_triangles(part, surface) ? triangle_count(part, surface) : 0;
    return count;
}

template <class Visit>
void visit_parts(Scene& scene, const Visit& visit)
{
    for (Part& prototype : scene.prototypes)
        visit(prototype);
    visit(scene.root);
}

/// @return number of meshes that got normals
std::size_t round_creases(Part& part, double crease_angle_deg)
{
    std::size_t rounded = 0;
    const std::size_t count = part.surfaces.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Surface surface = part.surfaces[i];
        if (surface.shape != Shape::mesh || !part.meshes[surface.index]->normals.empty())
            continue;
        SplitMesh split = split_creases(*part.meshes[surface.index], crease_angle_deg);
        if (!split.curved)
            continue;
        ++rounded;
        part.meshes[surface.index] = split.curved;
        if (split.flat)
            part.add_mesh(split.flat, surface.modifier, surface.name);
    }
    return rounded;
}

void join_triangles(Imported& imported)
{
    std::size_t polygons = 0, held = 0;
    visit_parts(imported.scene, [&](Part& part) {
        const std::size_t triangles = plain_triangles(part);
        if (triangles > most_triangles)
            held += triangles;
        else if (triangles > 1)
            polygons += PartRecovery(part, groups_of(part, imported)).run();
    });
    if (polygons > 0)
        imported.report.add(Finding::converted, "surfaces",
                            "polygon made of the triangles that lie in its plane (--keep-triangles refuses)", polygons);
    if (held > 0)
        imported.report.add(
            Finding::ignored, "surfaces",
            "triangle of a part of more than " + std::to_string(most_triangles) + ": not looked at for polygons", held);
}

} // namespace

void recover_surfaces(Imported& imported, const ImportOptions& options)
{
    if (options.crease_angle_deg) {
        if (!(*options.crease_angle_deg > 0 && *options.crease_angle_deg <= 180))
            throw InputError("crease angle", "is " + shortest(*options.crease_angle_deg) + " degrees",
                             "expected more than 0 and at most 180");
        std::size_t rounded = 0;
        visit_parts(imported.scene, [&](Part& part) { rounded += round_creases(part, *options.crease_angle_deg); });
        if (rounded > 0)
            imported.report.add(Finding::converted, "surfaces",
                                "mesh given normals across edges bent less than " +
                                    shortest(*options.crease_angle_deg) + " degrees",
                                rounded);
    }
    if (!options.keep_triangles)
        join_triangles(imported);
}

} // namespace lightwell
