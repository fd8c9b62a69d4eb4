#include "engine/base/files.h"
#include "importers/generators/scene_text_out.h"
#include "importers/radiance/words.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/library_path.h"
#include "plugins/commands/mapping_rules.h"
#include "plugins/commands/obj_faces.h"

#include <cmath>
#include <ostream>
#include <set>

namespace lightwell::commands {
namespace {

struct Wish {
    bool qualifiers = false, flat = false;
    std::string rules, object, input;
};

Wish wish_of(const std::vector<std::string>& words)
{
    Wish wish;
    std::size_t i = 1;
    for (; i < words.size() && words[i].size() > 1 && words[i][0] == '-'; ++i) {
        if (words[i] == "-n")
            wish.qualifiers = true;
        else if (words[i] == "-f")
            wish.flat = true;
        else if (words[i] == "-m" && i + 1 < words.size())
            wish.rules = words[++i];
        else if (words[i] == "-o" && i + 1 < words.size())
            wish.object = words[++i];
        else
            throw Fatal("unknown option: '" + words[i] + "'");
    }
    if (i + 1 < words.size())
        throw Fatal("too many file arguments: '" + words[i + 1] + "'");
    if (i < words.size())
        wish.input = words[i];
    return wish;
}

const std::vector<std::string>& qualifiers()
{
    static const std::vector<std::string> all{"Material", "Map", "Group", "Object", "Face"};
    return all;
}

/// The names that rules may ask for, as a mapping is begun from.
void write_qualifiers(const ObjFile& file, std::ostream& out)
{
    std::set<std::string> materials, groups, objects;
    for (const ObjState& state : file.states) {
        materials.insert(state.material);
        groups.insert(state.groups.begin(), state.groups.end());
        objects.insert(state.object);
    }
    const auto list = [&](const char* qualifier, std::set<std::string> names) {
        names.erase("");
        if (names.empty())
            return;
        out << "qualifier " << qualifier << " begin\n";
        for (const std::string& name : names)
            out << '"' << name << "\"\n";
        out << "end\n";
    };
    list("Material", materials);
    list("Group", groups);
    list("Object", objects);
    if (!file.faces.empty())
        out << "qualifier Face begin\n[1:" << file.faces.back().number << "]\nend\n";
}

/// What one face becomes.
class FaceWriter {
public:
    FaceWriter(const Wish& wish, const ObjFile& file, std::string& text) : wish_(wish), file_(file), text_(text)
    {
        if (wish.rules.empty())
            return;
        const auto found = find_in_library(wish.rules);
        if (!found)
            throw Fatal("cannot open mapping file \"" + wish.rules + "\"");
        rules_.emplace(MappedFile(*found).bytes(), wish.rules, qualifiers());
    }

    void write(const ObjFace& face)
    {
        const std::optional<std::string> material = material_of(face);
        const Vec3 flat = flat_normal(file_, face);
        if (!material || flat == Vec3{})
            return;
        const ObjState& state = file_.states[face.state];
        const std::string object = !wish_.object.empty() ? wish_.object : !state.groups.empty() ? state.groups[0] : "f";
        name_ = scene_text::encoded_name(object + "." + std::to_string(face.number));
        modifier_ = scene_text::encoded_name(*material);
        if (!smooth(face, flat))
            return generators::append_polygon(text_, modifier_, name_, corners(face));
        int part = 0;
        for (const auto& triangle : triangles_of(file_, face))
            smooth_triangle(triangle, name_ + '_' + std::to_string(++part));
    }

private:
    std::optional<std::string> material_of(const ObjFace& face) const
    {
        const ObjState& state = file_.states[face.state];
        if (rules_)
            return rules_->material_of({{"Material", {state.material}},
                                        {"Group", state.groups},
                                        {"Object", {state.object}},
                                        {"Face", {std::to_string(face.number)}}});
        return !state.material.empty() ? state.material : !state.groups.empty() ? state.groups[0] : "white";
    }
    std::vector<Point> corners(const ObjFace& face) const
    {
        std::vector<Point> all;
        for (std::uint32_t i = face.first; i < face.first + face.count; ++i)
            all.push_back(point(i));
        return all;
    }
    const Point& point(std::uint32_t corner) const
    {
        return file_.points[static_cast<std::size_t>(file_.corners[corner].point)];
    }
    const Vec3& normal(std::uint32_t corner) const
    {
        return file_.normals[static_cast<std::size_t>(file_.corners[corner].normal)];
    }
    /// Whether all corners have normals, and one of them says something else than the plane.
    bool smooth(const ObjFace& face, const Vec3& flat) const
    {
        constexpr double same_direction = 1 - 1e-6; // cosine: what three digits of a normal come to
        bool bent = false;
        for (std::uint32_t i = face.first; i < face.first + face.count; ++i) {
            if (wish_.flat || file_.corners[i].normal < 0)
                return false;
            bent |= !(dot(normalized(normal(i)), flat) >= same_direction);
        }
        return bent;
    }
    /// Each part of the normal is linear in the two coordinates of the plane that the triangle faces most.
    void smooth_triangle(const std::array<std::uint32_t, 3>& triangle, const std::string& name)
    {
        const Point &a = point(triangle[0]), &b = point(triangle[1]), &c = point(triangle[2]);
        const Vec3 area = cross(b - a, c - a);
        const int axis = std::fabs(area.x) > std::fabs(area.y) ? (std::fabs(area.x) > std::fabs(area.z) ? 0 : 2)
                                                               : (std::fabs(area.y) > std::fabs(area.z) ? 1 : 2);
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double u1 = b[u] - a[u], u2 = c[u] - a[u], v1 = b[v] - a[v], v2 = c[v] - a[v], spread = u1 * v2 - u2 * v1;
        if (spread == 0)
            return;
        text_ += '\n' + modifier_ + " texfunc T-nor\n4 dx dy dz tmesh.cal\n0\n10 " + std::to_string(axis) + '\n';
        const Vec3 na = normalized(normal(triangle[0])), nb = normalized(normal(triangle[1])),
                   nc = normalized(normal(triangle[2]));
        for (int i = 0; i < 3; ++i) {
            const double n1 = nb[i] - na[i], n2 = nc[i] - na[i];
            const double along_u = (n1 * v2 - n2 * v1) / spread, along_v = (n2 * u1 - n1 * u2) / spread;
            text_ += generators::column(along_u) + generators::column(along_v) +
                     generators::column(na[i] - along_u * a[u] - along_v * a[v]) + '\n';
        }
        generators::append_polygon(text_, "T-nor", name, {a, b, c});
    }

    const Wish& wish_;
    const ObjFile& file_;
    std::string& text_;
    std::optional<MappingRules> rules_;
    std::string name_, modifier_;
};

} // namespace

/// obj2rad: the faces of a Wavefront file as scene text, or the names that a mapping of materials is made from.
int obj2rad(const std::vector<std::string>& words, const Streams& streams)
{
    const Wish wish = wish_of(words);
    const ObjFile file = read_obj_input(wish.input, streams);
    if (wish.qualifiers) {
        write_qualifiers(file, streams.out);
        return 0;
    }
    std::string text = generators::comment_of(words);
    FaceWriter writer(wish, file, text);
    for (const ObjFace& face : file.faces)
        writer.write(face);
    streams.out << text;
    warn_of_unknown_statements(words[0], file, streams.err);
    return 0;
}

} // namespace lightwell::commands
