#include "importers/export/export.h"
#include "importers/export/faces.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/layer_rules.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace lightwell {
namespace {

constexpr std::size_t most_faces = 50'000'000;

struct PointHash {
    std::size_t operator()(const Point& p) const
    {
        std::size_t hash = 0;
        for (const double x : {p.x, p.y, p.z})
            hash = hash * 1099511628211u + std::hash<double>{}(x);
        return hash;
    }
};

/// A name as one line: control characters would end it, a `#` after a blank would begin a comment.
std::string one_line(std::string name)
{
    for (std::size_t i = 0; i < name.size(); ++i)
        if (static_cast<unsigned char>(name[i]) < 0x20 || (name[i] == '#' && (i == 0 || name[i - 1] == ' ')))
            name[i] = '_';
    if (!name.empty() && name.back() == '\\')
        name.back() = '_';
    return name;
}

class ObjWriter {
public:
    ObjWriter(const Imported& model, const ExportOptions& options, Report& report)
        : model_(model), options_(options), report_(report)
    {
    }
    void add(const Part& part, const Surface& surface, const Affine& map, ModifierId modifier);
    std::string text(const std::string& library) const
    {
        return "# Lightwell\n# unit: m\n# up: z\n" + (materials_.empty() ? "" : "mtllib " + library + '\n') + text_;
    }
    std::string library() const;
    bool has_materials() const { return !materials_.empty(); }

private:
    void select(ModifierId modifier);
    std::size_t vertex(const Point& point);
    void add_smooth(const Mesh& mesh, const Affine& map);

    const Imported& model_;
    const ExportOptions& options_;
    Report& report_;
    std::string text_, names_;
    std::unordered_map<Point, std::size_t, PointHash> vertices_;
    std::map<std::string, ModifierId> materials_;
    std::size_t normals_ = 0;
};

/// Groups are words: a layer with blanks is written as the object instead, which readers take where no group is.
void ObjWriter::select(ModifierId modifier)
{
    const SurfaceKey& key = key_of(model_, modifier);
    const std::string layer = one_line(key.layer), block = one_line(key.block);
    const std::string lower = lowercase_ascii(layer);
    const bool is_word = layer.find_first_of(" \t") == std::string::npos && lower != "default" && lower != "off";
    std::string names =
        is_word ? "o " + (block.empty() ? layer : block) + "\ng " + layer + '\n' : "o " + layer + "\ng default\n";
    std::string material = material_name_of(model_, modifier);
    if (material.empty() && key.colour)
        material = "rgb_" + colour_text(key).substr(1);
    if (!material.empty()) {
        material = one_line(material);
        materials_.try_emplace(material, modifier);
    }
    if (!material.empty() || !materials_.empty()) // a material lasts until the next one
        names += "usemtl " + (material.empty() ? std::string("none") : material) + '\n';
    if (names == names_)
        return;
    text_ += names_ = names;
}

std::size_t ObjWriter::vertex(const Point& point)
{
    const auto [entry, fresh] = vertices_.try_emplace(point, vertices_.size() + 1);
    if (fresh)
        text_ += "v " + shortest(point.x) + ' ' + shortest(point.y) + ' ' + shortest(point.z) + '\n';
    return entry->second;
}

void ObjWriter::add_smooth(const Mesh& mesh, const Affine& map)
{
    std::vector<std::size_t> points;
    for (const Point& point : mesh.points)
        points.push_back(vertex(map.point(point)));
    for (const Direction& normal : mesh.normals) {
        const Direction n = transform_normal(map, normal);
        text_ += "vn " + shortest(n.x) + ' ' + shortest(n.y) + ' ' + shortest(n.z) + '\n';
    }
    const bool mirrored = map.determinant() < 0;
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        text_ += 'f';
        for (const std::size_t corner : {i, mirrored ? i + 2 : i + 1, mirrored ? i + 1 : i + 2}) {
            const std::uint32_t index = mesh.triangles[corner];
            text_ += ' ' + std::to_string(points[index]) + "//" + std::to_string(normals_ + index + 1);
        }
        text_ += '\n';
    }
    normals_ += mesh.normals.size();
}

void ObjWriter::add(const Part& part, const Surface& surface, const Affine& map, ModifierId modifier)
{
    if (surface.shape == Shape::source) {
        report_.add(Finding::ignored, surface.name, "distant sources are not written: OBJ has none");
        return;
    }
    select(modifier);
    if (surface.shape == Shape::mesh && !part.meshes[surface.index]->normals.empty())
        return add_smooth(*part.meshes[surface.index], map);
    bool approximated = false;
    std::vector<Face> faces = faces_of(part, surface, options_.chord_tolerance_m, approximated);
    map_faces(faces, map);
    if (approximated)
        report_.add(Finding::approximated, surface.name, "round shapes are written as facets: OBJ has none");
    for (const Face& face : faces) {
        std::string corners;
        for (const Point& corner : face)
            corners += ' ' + std::to_string(vertex(corner));
        text_ += 'f' + corners + '\n';
    }
}

std::string ObjWriter::library() const
{
    std::string text = "# Lightwell\n";
    for (const auto& [name, modifier] : materials_) {
        const auto three = [](const Spectrum& c) {
            return shortest(c.r) + ' ' + shortest(c.g) + ' ' + shortest(c.b) + '\n';
        };
        const Material* material = material_of(model_, modifier);
        text += "newmtl " + name + "\nKd " + three(shown_colour(model_, modifier));
        if (material && is_emitter(*material))
            text += "Ke " + three(to_rec709(emitted_radiance(*material)));
        if (const auto* glass = material ? std::get_if<Glass>(material) : nullptr)
            text += "illum 6\nd 0\nNi " + shortest(glass->index) + "\nTf " + three(to_rec709(glass->transmissivity));
        if (const auto* metal = material ? std::get_if<Metal>(material) : nullptr)
            text += "Pm 1\nPr " + shortest(std::sqrt(metal->roughness)) + '\n';
    }
    return text;
}

} // namespace

void export_obj(const Imported& model, const std::filesystem::path& file, const ExportOptions& options, Report& report)
{
    if (expanded_count(model.scene) > most_faces)
        throw InputError{file.string(), "the model has more than fifty million surfaces with its instances written out",
                         "export DXF or GLB, which keep instances"};
    ObjWriter writer{model, options, report};
    visit_expanded(model.scene, [&](const Part& part, const Surface& surface, const Affine& map, ModifierId modifier) {
        writer.add(part, surface, map, modifier);
    });
    std::filesystem::path library = file;
    library.replace_extension(".mtl");
    if (!model.scene.prototypes.empty())
        report.add(Finding::approximated, file.filename().string(), "instances are written out: OBJ has none");
    if (writer.has_materials())
        write_text_atomically(library, writer.library());
    write_text_atomically(file, writer.text(library.filename().string()));
}

} // namespace lightwell
