#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/obj/obj_file.h"
#include "importers/obj/obj_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

namespace lightwell {
namespace {

/// Comments about unit and axis stand at the top of a file; later ones (one for each of a million groups) are not
/// looked at.
constexpr std::size_t header_lines = 200;
/// Indices are 32-bit; 2^31 - 1 vertices would be a text of more than 12 GB.
constexpr std::size_t most_elements = std::numeric_limits<std::int32_t>::max();

/// Reads the statements of one file in order.
class ObjReader {
public:
    ObjReader(std::string_view text, const std::string& name) : lines_(text) { file_.name = name; }
    ObjFile read();

private:
    void statement(std::string_view word, std::string_view rest);
    bool rare_statement(std::string_view word, std::string_view rest);
    void comment(std::string_view text);
    void vertex(std::string_view rest);
    void texture(std::string_view rest);
    void normal(std::string_view rest);
    void face(std::string_view rest);
    void vertex_colour(std::string_view first, std::string_view rest);
    void free_form(std::string_view word);
    void smoothing(std::string_view group);
    std::uint32_t current_state();
    void check_faces();
    const char* bad_corner(const ObjFace& face);
    void write_notes();
    std::string place(std::size_t line) const { return file_.name + ":" + std::to_string(line); }

    ObjLines lines_;
    ObjFile file_;
    ObjState state_;
    std::optional<std::uint32_t> state_index_;
    std::unordered_map<std::string, std::uint32_t> known_states_;
    std::uint32_t faces_read_ = 0;
    std::uint32_t smoothing_ = 0;
    std::string curve_type_, curve_degree_; ///< of `cstype` and `deg`
    ObjTally weights_, bad_vertices_, bad_textures_, bad_normals_, unknown_, bad_faces_;
    std::string first_unknown_;
};

/// Three numbers at the front of `rest`; NaN for one that is missing or not a number.
Vec3 three_numbers(std::string_view& rest) noexcept
{
    Vec3 v;
    for (int axis = 0; axis < 3; ++axis)
        v[axis] = parse_double(next_word(rest)).value_or(std::numeric_limits<double>::quiet_NaN());
    return v;
}

/// One index of a corner: relative to the end when negative, as in the format.
/// @return -1 for an empty text, -2 for what is no index
std::int32_t index_in(std::string_view text, std::size_t count_so_far) noexcept
{
    if (text.empty())
        return -1;
    long long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value == 0)
        return -2;
    const long long index = value > 0 ? value - 1 : value + static_cast<long long>(count_so_far);
    return index < 0 || index > std::numeric_limits<std::int32_t>::max() ? -2 : static_cast<std::int32_t>(index);
}

ObjFile ObjReader::read()
{
    std::string_view line;
    while (lines_.next(line)) {
        std::string_view rest = line;
        const std::string_view word = next_word(rest);
        if (!word.empty())
            statement(word, rest);
        else if (lines_.number() <= header_lines)
            comment(trimmed(line));
        if (std::max(file_.points.size(), file_.corners.size()) >= most_elements)
            throw InputError(place(lines_.number()), "more than 2147483647 vertices or corners",
                             "split the file into parts");
    }
    if (file_.points.empty() && faces_read_ == 0 && file_.ledger.read_count() == 0)
        throw InputError(file_.name, "no vertex and no face found in " + std::to_string(lines_.number()) + " lines",
                         "expected an OBJ file with `v` and `f` lines");
    check_faces();
    write_notes();
    file_.unknown_statements = unknown_.count;
    return std::move(file_);
}

void ObjReader::statement(std::string_view word, std::string_view rest)
{
    if (word == "v") {
        vertex(rest);
    } else if (word == "f" || word == "fo") {
        face(rest);
    } else if (word == "vn") {
        normal(rest);
    } else if (word == "vt") {
        texture(rest);
    } else if (word == "o") {
        state_.object = to_utf8(name_in(rest));
        state_index_.reset();
    } else if (word == "g") {
        state_.groups.clear();
        for (const std::string_view group : split(name_in(rest)))
            state_.groups.push_back(to_utf8(group));
        state_index_.reset();
    } else if (word == "usemtl") {
        state_.material = to_utf8(name_in(rest));
        state_index_.reset();
    } else if (!rare_statement(word, rest)) {
        if (unknown_.count == 0)
            first_unknown_ = to_utf8(word.substr(0, 40));
        unknown_.add(lines_.number());
    }
}

/// What has no area or no meaning for light.  @return false when the format has no such statement
bool ObjReader::rare_statement(std::string_view word, std::string_view rest)
{
    static constexpr std::string_view quiet[] = {"bmat",     "step",     "parm",  "trim",       "hole",      "scrv",
                                                 "sp",       "end",      "con",   "vp",         "mg",        "bevel",
                                                 "c_interp", "d_interp", "lod",   "shadow_obj", "trace_obj", "res",
                                                 "vw",       "usemap",   "ctech", "stech",      "maplib"};
    const std::string layer = layer_of(state_);
    if (word == "mtllib") {
        file_.libraries.push_back(to_utf8(name_in(rest)));
    } else if (word == "s") {
        smoothing(next_word(rest));
    } else if (word == "cstype") {
        curve_type_ = to_utf8(trimmed(rest).substr(0, 40));
    } else if (word == "deg") {
        curve_degree_ = to_utf8(trimmed(rest).substr(0, 40));
    } else if (word == "l") {
        file_.ledger.skipped("line", layer, "a line has no area");
    } else if (word == "p") {
        file_.ledger.skipped("point", layer, "a point has no area");
    } else if (word == "curv" || word == "curv2" || word == "cdc" || word == "cdp" || word == "surf" || word == "bsp" ||
               word == "bzp") {
        free_form(word);
    } else if (word == "call" || word == "csh") {
        file_.report.add(Finding::ignored, place(lines_.number()), "`call` and `csh` are never carried out");
    } else {
        return std::find(std::begin(quiet), std::end(quiet), word) != std::end(quiet);
    }
    return true;
}

/// Free-form statements, and those that the format had for them in its first version (`bsp`, `bzp`, `cdc`, `cdp`).
void ObjReader::free_form(std::string_view word)
{
    const bool surface = word == "surf" || word == "bsp" || word == "bzp";
    const char* reason = surface ? "free-form surfaces are not modelled yet" : "a curve has no area";
    const bool old = word == "bsp" || word == "bzp" || word == "cdc" || word == "cdp";
    std::string text = surface ? "free-form surface (" : "curve (";
    text.append(old || curve_type_.empty() ? word : std::string_view(curve_type_));
    if (!old && !curve_degree_.empty())
        text.append(" of degree ").append(curve_degree_);
    file_.ledger.skipped(surface ? "free-form surface" : "curve", layer_of(state_), reason);
    file_.report.add(surface ? Finding::unsupported : Finding::ignored, place(lines_.number()),
                     text.append(") left out: ").append(reason));
}

void ObjReader::smoothing(std::string_view group)
{
    const std::optional<long long> number = parse_integer(group);
    const bool names_none = group.empty() || group == "off" || (number && *number == 0);
    constexpr std::uint32_t one_group = 1; // "on", and what else is no number
    smoothing_ = names_none ? 0
                 : number && *number > 0 && *number < std::numeric_limits<std::int32_t>::max()
                     ? static_cast<std::uint32_t>(*number)
                     : one_group;
}

void ObjReader::comment(std::string_view text)
{
    const std::string lower = lowercase_ascii(text.substr(std::min(text.find_first_not_of("# \t"), text.size())));
    const auto value_after = [&](std::string_view key, char sign) -> std::string {
        if (lower.compare(0, key.size(), key) != 0)
            return {};
        const std::string_view rest = trimmed(std::string_view(lower).substr(key.size()));
        return !rest.empty() && rest[0] == sign ? std::string(trimmed(rest.substr(1))) : std::string();
    };
    for (const auto& found : {value_after("unit", ':'), value_after("units", ':'), value_after("file units", '=')})
        if (!found.empty() && file_.unit.empty())
            file_.unit = found;
    if (const std::string up = value_after("up", ':'); up == "y" || up == "z")
        file_.up = up;
    if (lower.rfind("freecad", 0) == 0)
        file_.written_by = "FreeCAD";
}

void ObjReader::vertex(std::string_view rest)
{
    const Vec3 point = three_numbers(rest);
    file_.points.push_back(point);
    if (!is_finite(point))
        bad_vertices_.add(lines_.number());
    const std::string_view fourth = next_word(rest);
    if (!fourth.empty() || !file_.colours.empty())
        vertex_colour(fourth, rest);
}

/// What follows x y z: nothing, a weight, a colour, or both.
void ObjReader::vertex_colour(std::string_view fourth, std::string_view rest)
{
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    std::vector<std::string_view> words{fourth};
    while (words.size() < 5 && !words.back().empty())
        words.push_back(next_word(rest));
    words.pop_back();
    const std::size_t more = words.size();
    if (more == 1 || more == 4)
        weights_.add(lines_.number());
    if (more < 3 && file_.colours.empty())
        return;
    file_.colours.resize(3 * file_.points.size(), none);
    for (std::size_t c = 0; more >= 3 && c < 3; ++c)
        file_.colours[3 * file_.points.size() - 3 + c] =
            static_cast<float>(parse_double(words[more - 3 + c]).value_or(none));
}

void ObjReader::texture(std::string_view rest)
{
    for (int i = 0; i < 2; ++i) {
        const double value = parse_double(next_word(rest)).value_or(0);
        file_.texture.push_back(std::isfinite(value) ? value : 0);
    }
}

void ObjReader::normal(std::string_view rest)
{
    const Vec3 normal = three_numbers(rest);
    file_.normals.push_back(is_finite(normal) ? normalized(normal) : Vec3{});
}

std::uint32_t ObjReader::current_state()
{
    if (state_index_)
        return *state_index_;
    std::string key = state_.object + '\n' + state_.material;
    for (const std::string& group : state_.groups)
        key += '\n' + group;
    const auto [entry, fresh] = known_states_.try_emplace(key, static_cast<std::uint32_t>(file_.states.size()));
    if (fresh)
        file_.states.push_back(state_);
    state_index_ = entry->second;
    return entry->second;
}

void ObjReader::face(std::string_view rest)
{
    ObjFace face{static_cast<std::uint32_t>(file_.corners.size()),
                 0,
                 current_state(),
                 static_cast<std::uint32_t>(lines_.number()),
                 ++faces_read_,
                 smoothing_};
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
        std::string_view parts[3];
        for (std::size_t i = 0; i < 3 && !word.empty(); ++i) {
            const std::size_t slash = std::min(word.find('/'), word.size());
            parts[i] = word.substr(0, slash);
            word.remove_prefix(std::min(slash + 1, word.size()));
        }
        ObjCorner corner{index_in(parts[0], file_.points.size()), index_in(parts[1], file_.texture.size() / 2),
                         index_in(parts[2], file_.normals.size())};
        if (corner.point == -1)
            corner.point = -2;
        file_.corners.push_back(corner);
        ++face.count;
    }
    file_.faces.push_back(face);
}

/// Why a face cannot be used; nullptr when it can. Texture and normal indices that lead nowhere are dropped.
const char* ObjReader::bad_corner(const ObjFace& face)
{
    if (face.count < 3)
        return "fewer than three corners";
    for (std::uint32_t i = face.first; i < face.first + face.count; ++i) {
        ObjCorner& corner = file_.corners[i];
        if (corner.point < 0 || static_cast<std::size_t>(corner.point) >= file_.points.size())
            return "a corner refers to a vertex that is not there";
        if (!is_finite(file_.points[static_cast<std::size_t>(corner.point)]))
            return "a corner's coordinates are not finite numbers";
        if (corner.texture < -1 || corner.texture >= static_cast<std::int64_t>(file_.texture.size() / 2)) {
            bad_textures_.add(face.line);
            corner.texture = -1;
        }
        if (corner.normal < -1 || corner.normal >= static_cast<std::int64_t>(file_.normals.size())) {
            bad_normals_.add(face.line);
            corner.normal = -1;
        }
    }
    return nullptr;
}

/// After the last line, since a face may come before its vertices.
void ObjReader::check_faces()
{
    std::erase_if(file_.faces, [&](const ObjFace& face) {
        const char* reason = bad_corner(face);
        if (!reason)
            return false;
        bad_faces_.add(face.line);
        file_.ledger.skipped("face", layer_of(file_.states[face.state]), reason);
        file_.report.add(Finding::ignored, place(face.line), std::string("face left out: ") + reason);
        return true;
    });
}

void ObjReader::write_notes()
{
    const auto note = [&](const ObjTally& tally, Finding finding, const std::string& text) {
        if (tally.count > 0)
            file_.report.add(finding, place(tally.line), text, tally.count);
    };
    note(bad_vertices_, Finding::ignored, "vertex is not three finite numbers; faces that use it are left out");
    note(bad_textures_, Finding::repaired, "corner refers to a texture coordinate that is not there; it has none");
    note(bad_normals_, Finding::repaired, "corner refers to a normal that is not there; the face stays flat");
    note(weights_, Finding::ignored, "fourth coordinate of a vertex: it weighs rational curves only");
    note(unknown_, Finding::ignored, "unknown statement, the first is `" + first_unknown_ + "`");
}

/// UTF-16 with a byte order mark as UTF-8; nothing for other text.
std::optional<std::string> from_utf16(std::string_view bytes)
{
    const bool big = bytes.substr(0, 2) == "\xfe\xff", little = bytes.substr(0, 2) == "\xff\xfe";
    if (!big && !little)
        return {};
    const auto unit_at = [&](std::size_t i) {
        const auto first = static_cast<unsigned char>(bytes[i]), second = static_cast<unsigned char>(bytes[i + 1]);
        return static_cast<char32_t>(big ? first << 8 | second : second << 8 | first);
    };
    std::string text;
    for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
        char32_t code = unit_at(i);
        if (code >= 0xd800 && code < 0xdc00 && i + 3 < bytes.size() && (unit_at(i + 2) & 0xfc00) == 0xdc00) {
            code = 0x10000 + ((code - 0xd800) << 10) + (unit_at(i + 2) - 0xdc00);
            i += 2;
        }
        text += utf8_of(code);
    }
    return text;
}

} // namespace

std::string layer_of(const ObjState& state)
{
    for (const std::string& group : state.groups)
        if (group != "default" && group != "off")
            return group;
    if (!state.object.empty())
        return state.object;
    return state.material.empty() ? "default" : state.material;
}

ObjFile read_obj(std::string_view text, const std::string& name)
{
    if (const std::optional<std::string> converted = from_utf16(text))
        return ObjReader(*converted, name).read();
    if (text.substr(0, 3) == "\xef\xbb\xbf")
        text.remove_prefix(3);
    return ObjReader(text, name).read();
}

} // namespace lightwell
