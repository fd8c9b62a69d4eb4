#include "importers/radiance/mesh_text.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "importers/radiance/surface_text.h"
#include "importers/radiance/words.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

namespace lightwell::scene_text {
namespace {

/// Indices into points, texture coordinates and normals; -1: none.
using Corner = std::array<long long, 3>;

class MeshReader {
public:
    MeshReader(std::string file, bool by_material) : file_(std::move(file)), by_material_(by_material) {}

    void line(std::string_view text)
    {
        ++line_;
        words_ = split(text.substr(0, text.find('#')), " \t\r");
        if (words_.empty())
            return;
        if (words_[0] == "v")
            points_.push_back(vector());
        else if (words_[0] == "vn")
            normals_.push_back(unit_vector(vector()));
        else if (words_[0] == "vt")
            texture_.push_back({number(1), words_.size() > 2 ? number(2) : 0});
        else if (words_[0] == "f")
            face();
        else if (words_[0] == "usemtl" && by_material_)
            group_ = &groups_[words_.size() > 1 ? decoded_name(words_[1]) : ""];
    }

    /// The meshes by material; without `by_material` one, whose name is empty.
    std::map<std::string, Mesh> finish()
    {
        std::map<std::string, Mesh> meshes;
        for (auto& [name, group] : groups_) {
            Mesh& mesh = group.mesh;
            if (mesh.triangles.empty())
                continue;
            // Only complete lists are of use: one corner without a normal leaves them all without.
            if (mesh.normals.size() != mesh.points.size())
                mesh.normals.clear();
            if (mesh.texture.size() != 2 * mesh.points.size())
                mesh.texture.clear();
            meshes.emplace(name, std::move(mesh));
        }
        if (meshes.empty())
            throw InputError{file_, "no faces", "a mesh file has `v` and `f` lines"};
        return meshes;
    }

private:
    [[noreturn]] void reject(const std::string& what, const std::string& hint = {}) const
    {
        throw InputError{fmt::format("{}:{}", file_, line_), what, hint};
    }

    double number(std::size_t i) const
    {
        const auto value = i < words_.size() ? parse_double(words_[i]) : std::nullopt;
        if (!value || !std::isfinite(*value))
            reject(fmt::format("number {} of `{}` is \"{}\", expected a finite number", i, words_[0],
                               i < words_.size() ? words_[i] : "nothing"));
        return *value;
    }
    Vec3 vector() const { return {number(1), number(2), number(3)}; }

    Corner corner(std::string_view word) const
    {
        const std::size_t sizes[] = {points_.size(), texture_.size(), normals_.size()};
        Corner result{-1, -1, -1};
        for (std::size_t k = 0, begin = 0; k < 3 && begin <= word.size(); ++k) {
            const std::size_t end = std::min(word.find('/', begin), word.size());
            const std::string_view token = word.substr(begin, end - begin);
            begin = end + 1;
            if (token.empty() && k > 0)
                continue;
            const auto index = parse_integer(token);
            const long long size = static_cast<long long>(sizes[k]);
            if (!index || *index == 0 || *index > size || *index < -size)
                reject(fmt::format("face corner \"{}\": expected an index from 1 to {}", word, size));
            result[k] = *index > 0 ? *index - 1 : size + *index;
        }
        return result;
    }

    std::uint32_t vertex(const Corner& corner)
    {
        Mesh& mesh = group_->mesh;
        const auto [entry, fresh] = group_->known.try_emplace(corner, static_cast<std::uint32_t>(mesh.points.size()));
        if (fresh) {
            mesh.points.push_back(points_[static_cast<std::size_t>(corner[0])]);
            if (corner[1] >= 0) {
                const auto& uv = texture_[static_cast<std::size_t>(corner[1])];
                mesh.texture.insert(mesh.texture.end(), {uv[0], uv[1]});
            }
            if (corner[2] >= 0)
                mesh.normals.push_back(normals_[static_cast<std::size_t>(corner[2])]);
        }
        return entry->second;
    }

    void face()
    {
        std::vector<std::uint32_t> corners;
        for (std::size_t i = 1; i < words_.size(); ++i)
            corners.push_back(vertex(corner(words_[i])));
        if (corners.size() < 3)
            reject(fmt::format("a face has {} corners, expected at least 3", corners.size()));
        if (corners.size() > 3 && !convex(corners))
            reject("a face with more than three corners is not convex", "cut it into triangles");
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
            group_->mesh.triangles.insert(group_->mesh.triangles.end(), {corners[0], corners[i], corners[i + 1]});
    }

    bool convex(const std::vector<std::uint32_t>& corners) const
    {
        std::vector<Point> outline;
        for (const std::uint32_t c : corners)
            outline.push_back(group_->mesh.points[c]);
        const Vec3 area = polygon_area_vector(outline.data(), outline.size());
        const std::size_t n = outline.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 before = outline[i] - outline[(i + n - 1) % n], after = outline[(i + 1) % n] - outline[i];
            constexpr double straight = 1e-6; // sine of a bend that rounding of the file can make
            if (dot(cross(before, after), area) < -straight * length(before) * length(after) * length(area))
                return false;
        }
        return true;
    }

    std::string file_;
    std::size_t line_ = 0;
    std::vector<std::string_view> words_;
    std::vector<Point> points_, normals_;
    std::vector<std::array<double, 2>> texture_;
    struct Group {
        Mesh mesh;
        std::map<Corner, std::uint32_t> known;
    };
    bool by_material_;
    std::map<std::string, Group> groups_;
    Group* group_ = &groups_[""];
};

void append_line(std::string& text, const char* keyword, std::initializer_list<double> numbers)
{
    text += keyword;
    for (const double number : numbers)
        text.append(" ").append(shortest(number));
    text += '\n';
}

} // namespace

namespace {

constexpr std::string_view mesh_format = "FORMAT=Lightwell_tmesh\n\n", mesh_start = "#?RADIANCE\n",
                           parts_line = "materials triangles ";

struct MeshParts {
    std::string_view materials, triangles;
};

MeshParts parts_of(std::string_view bytes, const std::string& file)
{
    if (!is_mesh_file(bytes))
        return {{}, bytes};
    const std::size_t body = bytes.find(mesh_format) + mesh_format.size(), end = bytes.find('\n', body);
    const std::vector<std::string_view> sizes = bytes.substr(body, parts_line.size()) == parts_line
                                                    ? split(bytes.substr(body, end - body), " ")
                                                    : std::vector<std::string_view>{};
    const auto materials = sizes.size() == 4 ? parse_integer(sizes[2]) : std::nullopt;
    const auto triangles = sizes.size() == 4 ? parse_integer(sizes[3]) : std::nullopt;
    const auto left = static_cast<long long>(end == bytes.npos ? 0 : bytes.size() - end - 1);
    if (!materials || !triangles || *materials < 0 || *materials > left || *triangles != left - *materials)
        throw InputError{file, "the mesh file is damaged: it is not as long as it says", "make it again with obj2mesh"};
    const std::string_view rest = bytes.substr(end + 1);
    return {rest.substr(0, static_cast<std::size_t>(*materials)), rest.substr(static_cast<std::size_t>(*materials))};
}

std::map<std::string, Mesh> read_meshes(const std::filesystem::path& file, bool by_material)
{
    const MappedFile mapped(file);
    MeshReader reader(file.filename().string(), by_material);
    std::string_view rest = parts_of(mapped.bytes(), file.string()).triangles;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        reader.line(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return reader.finish();
}

} // namespace

Mesh read_mesh_text(const std::filesystem::path& file)
{
    return std::move(read_meshes(file, false).begin()->second);
}

std::map<std::string, Mesh> read_meshes_by_material(const std::filesystem::path& file)
{
    return read_meshes(file, true);
}

namespace {

/// What stands in a text already.
struct Listed {
    std::size_t points = 0, texture = 0, normals = 0;
};

void append_mesh(std::string& text, const Mesh& mesh, const Listed& before)
{
    for (const Point& p : mesh.points)
        append_line(text, "v", {p.x, p.y, p.z});
    for (std::size_t i = 0; i + 1 < mesh.texture.size(); i += 2)
        append_line(text, "vt", {mesh.texture[i], mesh.texture[i + 1]});
    for (const Direction& n : mesh.normals)
        append_line(text, "vn", {n.x, n.y, n.z});
    const bool texture = !mesh.texture.empty(), normals = !mesh.normals.empty();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::size_t corner = mesh.triangles[i] + std::size_t{1};
        text += i % 3 == 0 ? "f " : " ";
        text += std::to_string(before.points + corner);
        if (texture || normals)
            text.append("/").append(texture ? std::to_string(before.texture + corner) : "");
        if (normals)
            text.append("/").append(std::to_string(before.normals + corner));
        if (i % 3 == 2)
            text += '\n';
    }
}

} // namespace

std::string mesh_text(const Mesh& mesh)
{
    std::string text = "# triangles of one mesh, in metres; written by Lightwell\n";
    append_mesh(text, mesh, {});
    return text;
}

std::string mesh_file(const std::string& command, const std::string& materials,
                      const std::map<std::string, Mesh>& meshes)
{
    std::string triangles;
    Listed before;
    for (const auto& [material, mesh] : meshes) {
        triangles += "usemtl " + (material.empty() ? "" : encoded_name(material)) + '\n';
        append_mesh(triangles, mesh, before);
        before.points += mesh.points.size();
        before.texture += mesh.texture.size() / 2;
        before.normals += mesh.normals.size();
    }
    return std::string(mesh_start) + command + '\n' + std::string(mesh_format) + std::string(parts_line) +
           std::to_string(materials.size()) + ' ' + std::to_string(triangles.size()) + '\n' + materials + triangles;
}

bool is_mesh_file(std::string_view bytes) noexcept
{
    constexpr std::size_t most_of_header = 1 << 16;
    return bytes.starts_with(mesh_start) && bytes.substr(0, most_of_header).find(mesh_format) != bytes.npos;
}

std::string_view materials_of_mesh_file(std::string_view bytes, const std::string& file)
{
    return parts_of(bytes, file).materials;
}

} // namespace lightwell::scene_text
