#include "importers/gltf/gltf_json.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/gltf/gltf_container.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

using Json = nlohmann::json;

Json parse(std::string_view text, const std::string& name)
{
    try {
        return Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
        throw InputError(name + ":" + std::to_string(line_of(text, error.byte)), "malformed JSON",
                         "the file is damaged or truncated; export it again");
    } catch (const Json::exception&) { // a number beyond every range
        throw InputError(name, "malformed JSON number", "the file is damaged; export it again");
    }
}

std::string text_at(const Json& object, const char* key)
{
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void check_version(const Json& root, const std::string& name)
{
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object())
        throw InputError(name, "no \"asset\" with a version", "expected glTF 2.0");
    for (const char* key : {"version", "minVersion"}) {
        const std::string version = text_at(*asset, key);
        const bool required = std::string_view(key) == "version";
        if (version.empty() && !required)
            continue;
        const bool known = required ? version.rfind("2.", 0) == 0 : version == "2.0";
        if (!known)
            throw InputError(name, std::string(key) + " is \"" + version.substr(0, 20) + "\", expected 2.0",
                             "export it as glTF 2.0");
    }
}

/// Lists must be arrays of objects: the parser takes that for granted.
void check_lists(Json& root, const std::string& name)
{
    for (const char* key :
         {"accessors", "bufferViews", "buffers", "cameras", "materials", "meshes", "nodes", "scenes"}) {
        const auto list = root.find(key);
        if (list == root.end())
            continue;
        if (!list->is_array())
            throw InputError(name, std::string("\"") + key + "\" is " + list->type_name() + ", expected array");
        for (std::size_t i = 0; i < list->size(); ++i)
            if (!(*list)[i].is_object())
                throw InputError(name, std::string(key) + "[" + std::to_string(i) + "] is " + (*list)[i].type_name() +
                                           ", expected object");
    }
}

void take_buffers(Json& root, GltfJson& result)
{
    for (const Json& buffer : root.value("buffers", Json::array())) {
        const auto length = buffer.find("byteLength");
        const bool given = length != buffer.end() && length->is_number_unsigned();
        result.buffers.push_back({text_at(buffer, "uri"), given ? length->get<std::size_t>() : 0});
    }
}

/// Moves what the parser need not see.
void take_parts(Json& root, GltfJson& result)
{
    Json parts = Json::object();
    for (const char* key : {"extensions", "images", "materials", "samplers", "skins", "textures"})
        if (const auto found = root.find(key); found != root.end()) {
            parts[key] = std::move(*found);
            root.erase(found);
        }
    result.parts = parts.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Whole numbers written as 12.0 become 12: the parser refuses them where it wants integers.
void settle_integers(Json& value)
{
    constexpr double largest = 2147483647;
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number >= 0 && number <= largest && number == std::floor(number))
            value = static_cast<std::uint64_t>(number);
        return;
    }
    if (value.is_structured())
        for (Json& item : value)
            settle_integers(item);
}

/// An accessor of an unknown type must not stop the file, only what uses it.
void settle_accessor_types(Json& root)
{
    static constexpr std::string_view known[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    constexpr unsigned unreadable_component_type = 5130; // known to the parser and to nobody else
    if (!root.contains("accessors"))
        return;
    for (Json& accessor : root["accessors"])
        if (std::find(std::begin(known), std::end(known), text_at(accessor, "type")) == std::end(known)) {
            accessor["type"] = "SCALAR";
            accessor["componentType"] = unreadable_component_type;
        }
}

/// Moves `indices` out of the parser's sight, who would refuse the whole file for one bad number.
void hide_indices(Json& root, const std::string& name)
{
    for (Json& mesh : root["meshes"]) {
        const auto primitives = mesh.find("primitives");
        if (primitives == mesh.end() || !primitives->is_array())
            continue;
        for (Json& primitive : *primitives) {
            if (!primitive.is_object() || !primitive.contains("attributes") || !primitive["attributes"].is_object())
                throw InputError(name, "a primitive of mesh \"" + text_at(mesh, "name") + "\" has no attributes");
            primitive["extras"] = Json::object();
            if (primitive.contains("indices") && primitive["indices"].is_number_integer())
                primitive["extras"]["indices"] = primitive["indices"];
            primitive.erase("indices");
        }
    }
}

} // namespace

GltfJson prepare_json(std::string_view json, const std::string& name, Report& report)
{
    check_json_depth(json, name);
    Json root = parse(json, name);
    if (!root.is_object())
        throw InputError(name, std::string("JSON is ") + root.type_name() + ", expected object");
    check_version(root, name);
    check_lists(root, name);
    settle_integers(root);
    settle_accessor_types(root);
    GltfJson result;
    result.generator = text_at(root["asset"], "generator");
    take_buffers(root, result);
    take_parts(root, result);
    if (root.contains("animations") && root["animations"].is_array())
        result.animations = root["animations"].size();
    if (root.contains("scene") && !root["scene"].is_number_unsigned()) {
        report.add(Finding::repaired, name, "\"scene\" is no index; the first scene is taken");
        root.erase("scene");
    }
    if (root.contains("meshes"))
        hide_indices(root, name);
    for (const char* key : {"animations", "buffers", "extras"})
        root.erase(key);
    result.text = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    return result;
}

} // namespace lightwell
