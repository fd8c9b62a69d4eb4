#include "plugins/serve/faces.h"

#include "engine/base/text.h"
#include "engine/scene/expansion.h"

#include <cmath>
#include <map>

namespace lightwell::serve {
namespace {

class FaceWalk {
public:
    using Visit = std::function<void(std::size_t root_surface, const PlacedFace& face)>;

    FaceWalk(const Scene& scene, const SceneOrigins& origins, const Visit& visit)
        : scene_(scene), origins_(origins), visit_(visit)
    {
    }
    void walk()
    {
        for (root_surface_ = 0; root_surface_ < scene_.root.surfaces.size(); ++root_surface_)
            add(scene_.root, scene_.root.surfaces[root_surface_], {}, {}, nullptr, nullptr);
    }

private:
    struct Place {
        const Place* outer;
        const std::vector<Binding>* bindings;
    };

    void add(const Part& part, const Surface& surface, const Affine& to_world, const std::string& path,
             const Place* place, const MeshFile* file)
    {
        if (surface.shape == Shape::source)
            return;
        if (surface.shape == Shape::instance) {
            const Instance& instance = part.instances[surface.index];
            const auto found = origins_.mesh_files.find(instance.prototype);
            const MeshFile* inner_file = found == origins_.mesh_files.end() ? nullptr : found->second.get();
            const Place inner{place, &instance.bindings};
            const Part& prototype = scene_.prototypes[instance.prototype];
            for (const Surface& below : prototype.surfaces)
                add(prototype, below, compose(to_world, instance.to_parent), path + surface.name + "/", &inner,
                    inner_file);
            return;
        }
        PlacedFace face{&part, &surface, to_world, surface.modifier, path + surface.name, -1, 0, {}};
        for (const Place* p = place; p != nullptr; p = p->outer)
            face.modifier = bound_modifier(scene_, face.modifier, *p->bindings);
        if (face.modifier == void_modifier)
            return;
        if (surface.shape == Shape::polygon)
            face.corners = part.polygons[surface.index].count;
        if (surface.shape == Shape::polygon && file != nullptr)
            face.number = parse_integer(surface.name).value_or(-1);
        if (surface.shape == Shape::mesh && file != nullptr)
            return add_faces_of_mesh(face, *file);
        visit_(root_surface_, face);
    }

    void add_faces_of_mesh(PlacedFace& face, const MeshFile& file)
    {
        const auto numbers = file.faces.find(face.part->meshes[face.surface->index].get());
        if (numbers == file.faces.end())
            return visit_(root_surface_, face);
        std::map<std::uint32_t, std::vector<std::uint32_t>> triangles;
        for (std::uint32_t i = 0; i < numbers->second.size(); ++i)
            triangles[numbers->second[i]].push_back(i);
        const std::string path = face.id.substr(0, face.id.size() - face.surface->name.size());
        for (auto& [number, list] : triangles) {
            face.number = number;
            face.id = path + std::to_string(number);
            face.corners = file.face_sizes[number];
            face.triangles = std::move(list);
            visit_(root_surface_, face);
        }
    }

    const Scene& scene_;
    const SceneOrigins& origins_;
    const Visit& visit_;
    std::size_t root_surface_ = 0;
};

template <class Use>
void each_triangle(const PlacedFace& face, const Use& use)
{
    const Mesh& mesh = *face.part->meshes[face.surface->index];
    const auto corner = [&](std::size_t triangle, std::size_t i) {
        return face.to_world.point(mesh.points[mesh.triangles[3 * triangle + i]]);
    };
    const std::size_t count = face.triangles.empty() ? mesh.triangles.size() / 3 : face.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t triangle = face.triangles.empty() ? i : face.triangles[i];
        use(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2));
    }
}

std::vector<Point> outline_of(const PlacedFace& face)
{
    const Polygon& polygon = face.part->polygons[face.surface->index];
    std::vector<Point> corners;
    for (std::uint32_t i = 0; i < polygon.count; ++i)
        corners.push_back(face.to_world.point(face.part->points[polygon.first + i]));
    return corners;
}

} // namespace

double PlacedFace::area_m2() const
{
    if (surface->shape == Shape::polygon) {
        const std::vector<Point> outline = outline_of(*this);
        return length(polygon_area_vector(outline.data(), outline.size()));
    }
    if (surface->shape == Shape::mesh) {
        double sum = 0;
        each_triangle(
            *this, [&](const Point& a, const Point& b, const Point& c) { sum += 0.5 * length(cross(b - a, c - a)); });
        return sum;
    }
    const double scale = std::cbrt(std::fabs(to_world.determinant()));
    return surface_area_m2(*part, *surface) * scale * scale;
}

Box PlacedFace::bounds() const
{
    Box box;
    if (surface->shape == Shape::polygon) {
        for (const Point& corner : outline_of(*this))
            box.extend(corner);
    } else if (surface->shape == Shape::mesh) {
        each_triangle(*this, [&](const Point& a, const Point& b, const Point& c) {
            for (const Point& corner : {a, b, c})
                box.extend(corner);
        });
    } else {
        box = transform_box(to_world, surface_bounds(*part, *surface));
    }
    return box;
}

void visit_faces(const Scene& scene, const SceneOrigins& origins,
                 const std::function<void(std::size_t root_surface, const PlacedFace& face)>& visit)
{
    FaceWalk(scene, origins, visit).walk();
}

const std::string& object_of(const Scene& scene, const SceneOrigins& origins, std::size_t root_surface)
{
    const bool named = root_surface < origins.objects.size() && !origins.objects[root_surface].empty();
    return named ? origins.objects[root_surface] : scene.root.surfaces[root_surface].name;
}

} // namespace lightwell::serve
