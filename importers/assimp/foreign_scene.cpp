#include "importers/assimp/foreign_scene.h"

#include "engine/base/errors.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace lightwell {
namespace {

constexpr std::string_view scene_mark = "LWFS0001", refusal_mark = "LWFR0001", end_mark = "LWFE0001";

template <class T>
concept PlainNumber = std::is_arithmetic_v<T>;

class Writer {
public:
    template <PlainNumber T>
    void item(const T& value)
    {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void item(const std::string& text) { list(text); }
    void item(const std::array<float, 3>& triple)
    {
        for (const float value : triple)
            item(value);
    }
    void item(const Affine& map)
    {
        for (const Vec3& column : {map.x, map.y, map.z, map.translation})
            for (int axis = 0; axis < 3; ++axis)
                item(column[axis]);
    }
    template <PlainNumber T>
    void item(const std::vector<T>& values)
    {
        list(values);
    }
    template <class T>
    void item(const std::vector<T>& values)
    {
        item(static_cast<std::uint64_t>(values.size()));
        for (const T& value : values)
            fields(*this, value);
    }
    void mark(std::string_view text) { bytes_.append(text); }
    std::string take() { return std::move(bytes_); }

private:
    template <class List>
    void list(const List& values)
    {
        item(static_cast<std::uint64_t>(values.size()));
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof *values.data());
    }
    std::string bytes_;
};

class Reader {
public:
    Reader(std::string_view bytes, const std::string& place) : left_(bytes), place_(place) {}
    template <PlainNumber T>
    void item(T& value)
    {
        std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
    }
    void item(bool& value)
    {
        char byte = 0;
        item(byte);
        value = byte != 0;
    }
    void item(std::string& text) { text = bytes(length(1)); }
    void item(std::array<float, 3>& triple)
    {
        for (float& value : triple)
            item(value);
    }
    void item(Affine& map)
    {
        for (Vec3* column : {&map.x, &map.y, &map.z, &map.translation})
            for (int axis = 0; axis < 3; ++axis)
                item((*column)[axis]);
    }
    template <PlainNumber T>
    void item(std::vector<T>& values)
    {
        values.resize(length(sizeof(T)));
        const std::string_view from = bytes(values.size() * sizeof(T));
        if (!from.empty())
            std::memcpy(values.data(), from.data(), from.size());
    }
    template <class T>
    void item(std::vector<T>& values)
    {
        values.clear();
        for (std::size_t left = length(1); left > 0; --left)
            fields(*this, values.emplace_back());
    }
    void mark(std::string_view text)
    {
        if (bytes(text.size()) != text)
            fail("has no mark where one is due");
    }
    bool done() const { return left_.empty(); }
    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError(place_, "the answer of the import program " + what,
                         "the file may be damaged; export it again, or as glTF or OBJ");
    }

private:
    std::string_view bytes(std::size_t count)
    {
        if (count > left_.size())
            fail("ends too early");
        const std::string_view head = left_.substr(0, count);
        left_.remove_prefix(count);
        return head;
    }
    /// Never more than can follow, so that nothing large is allocated for a length that is wrong.
    std::size_t length(std::size_t size_of_one)
    {
        std::uint64_t count = 0;
        item(count);
        if (count > left_.size() / size_of_one)
            fail("names more items than it has");
        return static_cast<std::size_t>(count);
    }
    std::string_view left_;
    const std::string& place_;
};

/// The one list of fields, for both directions.
template <class Stream, class Material>
requires std::is_same_v<std::remove_const_t<Material>, ForeignMaterial>
void fields(Stream& stream, Material& material)
{
    stream.item(material.name);
    stream.item(material.diffuse);
    stream.item(material.emission);
    stream.item(material.diffuse_stated);
    stream.item(material.opacity);
    stream.item(material.textures);
    stream.item(material.shiny);
}

template <class Stream, class Mesh>
requires std::is_same_v<std::remove_const_t<Mesh>, ForeignMesh>
void fields(Stream& stream, Mesh& mesh)
{
    stream.item(mesh.name);
    stream.item(mesh.material);
    stream.item(mesh.points);
    stream.item(mesh.normals);
    stream.item(mesh.face_sizes);
    stream.item(mesh.corners);
}

template <class Stream, class Node>
requires std::is_same_v<std::remove_const_t<Node>, ForeignNode>
void fields(Stream& stream, Node& node)
{
    stream.item(node.name);
    stream.item(node.parent);
    stream.item(node.to_parent);
    stream.item(node.meshes);
}

template <class Stream, class View>
requires std::is_same_v<std::remove_const_t<View>, ForeignCamera>
void fields(Stream& stream, View& camera)
{
    stream.item(camera.name);
    stream.item(camera.position);
    stream.item(camera.direction);
    stream.item(camera.up);
    stream.item(camera.horizontal_rad);
    stream.item(camera.aspect);
}

template <class Stream, class Text>
requires std::is_same_v<std::remove_const_t<Text>, std::string>
void fields(Stream& stream, Text& text)
{
    stream.item(text);
}

template <class Stream, class Scene>
requires std::is_same_v<std::remove_const_t<Scene>, ForeignScene>
void fields(Stream& stream, Scene& scene)
{
    stream.item(scene.materials);
    stream.item(scene.meshes);
    stream.item(scene.nodes);
    stream.item(scene.cameras);
    stream.item(scene.lights);
    stream.item(scene.centimetres_per_unit);
    stream.item(scene.up_axis);
    stream.item(scene.up_sign);
    stream.item(scene.animations);
}

void check_mesh(const ForeignScene& scene, const ForeignMesh& mesh, const Reader& reader)
{
    const std::size_t points = mesh.points.size() / 3;
    if (mesh.points.size() % 3 != 0 || (!mesh.normals.empty() && mesh.normals.size() != mesh.points.size()))
        reader.fail("has incomplete points");
    if (mesh.material >= scene.materials.size())
        reader.fail("names a material that is not there");
    std::uint64_t corners = 0;
    for (const std::uint32_t size : mesh.face_sizes)
        corners += size;
    if (corners != mesh.corners.size())
        reader.fail("has faces without corners");
    for (const std::uint32_t corner : mesh.corners)
        if (corner >= points)
            reader.fail("names a point that is not there");
}

void check(const ForeignScene& scene, const Reader& reader)
{
    for (const ForeignMesh& mesh : scene.meshes)
        check_mesh(scene, mesh, reader);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].parent < -1 || scene.nodes[i].parent >= static_cast<std::int64_t>(i))
            reader.fail("has nodes that do not form a tree");
        for (const std::uint32_t mesh : scene.nodes[i].meshes)
            if (mesh >= scene.meshes.size())
                reader.fail("names a mesh that is not there");
    }
}

} // namespace

std::string scene_to_bytes(const ForeignScene& scene)
{
    Writer writer;
    writer.mark(scene_mark);
    fields(writer, scene);
    writer.mark(end_mark);
    return writer.take();
}

std::string refusal_to_bytes(const std::string& reason)
{
    return std::string(refusal_mark).append(reason);
}

ForeignScene scene_from_bytes(std::string_view bytes, const std::string& place)
{
    constexpr std::size_t longest_reason = 400;
    if (bytes.substr(0, refusal_mark.size()) == refusal_mark) {
        std::string reason(bytes.substr(refusal_mark.size(), longest_reason));
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        throw InputError(place, "cannot be read: " + reason, "export it again, or as glTF or OBJ");
    }
    Reader reader(bytes, place);
    ForeignScene scene;
    reader.mark(scene_mark);
    fields(reader, scene);
    reader.mark(end_mark);
    if (!reader.done())
        reader.fail("goes on after its end");
    check(scene, reader);
    return scene;
}

} // namespace lightwell
