#include "importers/dxf/external_files.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace lightwell::dxf {
namespace {

/// A tree of references that reads more files than this would go on for hours.
constexpr std::size_t most_files = 256;
constexpr std::size_t deepest = 16;

/// Where the file of a reference lies; empty when it is not there. A DWG is looked for as the DXF of the same name.
std::filesystem::path find_beside(const std::filesystem::path& drawing, std::string path)
{
    std::replace(path.begin(), path.end(), '\\', '/');
    std::filesystem::path wanted{path};
    if (lowercase_ascii(wanted.extension().string()) != ".dxf")
        wanted.replace_extension(".dxf");
    const bool has_drive = path.size() > 1 && path[1] == ':';
    std::error_code ignored;
    for (const auto& candidate : {has_drive || wanted.is_absolute() ? wanted.filename() : wanted, wanted.filename()})
        if (!candidate.empty() && std::filesystem::is_regular_file(drawing.parent_path() / candidate, ignored))
            return std::filesystem::weakly_canonical(drawing.parent_path() / candidate, ignored);
    return {};
}

/// Moves all of one drawing into another, as a block of it.
class Absorber {
public:
    Absorber(Drawing& into, Drawing from, const std::string& reference)
        : into_(into), from_(std::move(from)), prefix_(reference + "|"), first_file_(into.files.size())
    {
        for (std::size_t i = 0; i < into_.layers.size(); ++i)
            layers_of_name_.emplace(lowercase_ascii(into_.layers[i].name), static_cast<std::uint32_t>(i));
    }
    void absorb(Block& block);

private:
    void map_layers();
    void map_names();
    void move_entities(const EntityRange& range, bool with_paper);
    void move_blocks();
    void move_attributes();
    std::uint64_t moved_place(std::uint64_t place) const
    {
        return place_in_file(place & (place_in_file(0, 1) - 1), first_file_ + (place >> file_bit));
    }

    Drawing& into_;
    Drawing from_;
    std::string prefix_;
    std::size_t first_file_;
    std::unordered_map<std::string, std::uint32_t> layers_of_name_;
    std::vector<std::uint32_t> layers_, types_, block_names_; ///< new index of each old one
    std::unordered_map<std::size_t, std::size_t> inserts_;    ///< new index of each INSERT that moved
};

void Absorber::map_layers()
{
    constexpr std::size_t layer_zero = 0;
    for (std::size_t i = 0; i < from_.layers.size(); ++i) {
        if (i == layer_zero) {
            layers_.push_back(0);
            continue;
        }
        Layer layer = from_.layers[i];
        layer.name = prefix_ + layer.name;
        const auto [entry, fresh] =
            layers_of_name_.try_emplace(lowercase_ascii(layer.name), static_cast<std::uint32_t>(into_.layers.size()));
        layers_.push_back(entry->second);
        if (fresh)
            into_.layers.push_back(std::move(layer));
        else if (!into_.layers[entry->second].is_defined) // else the drawing says how it wants to see the layer
            into_.layers[entry->second] = std::move(layer);
    }
}

void Absorber::map_names()
{
    for (const std::string& type : from_.types) {
        const auto known = std::find(into_.types.begin(), into_.types.end(), type);
        types_.push_back(static_cast<std::uint32_t>(known - into_.types.begin()));
        if (known == into_.types.end())
            into_.types.push_back(type);
    }
    for (std::size_t i = 0; i < from_.block_names.size(); ++i) {
        block_names_.push_back(static_cast<std::uint32_t>(into_.block_names.size()));
        into_.block_names.push_back(prefix_ + from_.block_names[i]);
        const std::uint32_t block = from_.block_of_name[i];
        into_.block_of_name.push_back(block == no_index ? no_index
                                                        : block + static_cast<std::uint32_t>(into_.blocks.size()));
    }
}

void Absorber::move_entities(const EntityRange& range, bool with_paper)
{
    for (std::size_t i = range.first; i < range.first + range.count; ++i) {
        Entity entity = from_.entities[i];
        if (entity.in_paper_space && !with_paper)
            continue;
        entity.layer = layers_[entity.layer];
        entity.type = types_[entity.type];
        if (entity.block_name != no_index)
            entity.block_name = block_names_[entity.block_name];
        entity.place = moved_place(entity.place);
        if (entity.kind == Kind::insert)
            inserts_[i] = into_.entities.size();
        into_.entities.push_back(entity);
    }
}

void Absorber::move_blocks()
{
    for (Block block : from_.blocks) {
        const std::size_t first = into_.entities.size();
        move_entities(block.entities, true);
        block.entities = {first, into_.entities.size() - first};
        block.place = moved_place(block.place);
        into_.blocks.push_back(std::move(block));
    }
}

void Absorber::move_attributes()
{
    for (Attribute& attribute : from_.attributes)
        if (const auto insert = inserts_.find(attribute.insert); insert != inserts_.end()) {
            attribute.insert = insert->second;
            attribute.layer = layers_[attribute.layer];
            into_.attributes.push_back(std::move(attribute));
        }
}

void Absorber::absorb(Block& block)
{
    map_layers();
    map_names();
    into_.files.insert(into_.files.end(), from_.files.begin(), from_.files.end());
    block.entities.first = into_.entities.size();
    for (const EntityRange& range : from_.model)
        move_entities(range, false);
    block.entities.count = into_.entities.size() - block.entities.first;
    block.source = BlockSource::drawing;
    if (block.base == Point{})
        block.base = from_.base;
    const double unit = unit_of_insunits(into_.insunits.value_or(0)).value;
    const double other = unit_of_insunits(from_.insunits.value_or(0)).value;
    if (unit > 0 && other > 0)
        block.scale = other / unit;
    const Block done = std::move(block); // move_blocks() grows the list that it stands in
    const auto at = static_cast<std::size_t>(&block - into_.blocks.data());
    move_blocks();
    into_.blocks[at] = done;
    move_attributes();
    into_.values.take_over(std::move(from_.values));
}

class ReferenceReader {
public:
    explicit ReferenceReader(Report& report) : report_(report) {}
    Drawing read(const std::filesystem::path& file)
    {
        std::error_code ignored;
        open_.push_back(std::filesystem::weakly_canonical(file, ignored));
        ++files_;
        Drawing drawing = read_drawing(file, report_);
        const std::size_t own_blocks = drawing.blocks.size();
        for (std::size_t i = 0; i < own_blocks; ++i)
            follow(drawing, i, file);
        open_.pop_back();
        return drawing;
    }

private:
    void follow(Drawing& drawing, std::size_t block, const std::filesystem::path& file);
    std::string reference_name(const Drawing& drawing, std::size_t block) const;

    Report& report_;
    std::vector<std::filesystem::path> open_;
    std::size_t files_ = 0;
};

std::string ReferenceReader::reference_name(const Drawing& drawing, std::size_t block) const
{
    const auto name = std::find(drawing.block_of_name.begin(), drawing.block_of_name.end(), block);
    return name == drawing.block_of_name.end()
               ? std::string{}
               : drawing.block_names[static_cast<std::size_t>(name - drawing.block_of_name.begin())];
}

void ReferenceReader::follow(Drawing& drawing, std::size_t index, const std::filesystem::path& file)
{
    Block& block = drawing.blocks[index];
    const bool in_reference = open_.size() > 1;
    if (block.source == BlockSource::drawing || (block.source == BlockSource::overlay && in_reference))
        return;
    block.source = BlockSource::external;
    const std::string place = drawing.place(block.place), said = fmt::format("external reference \"{}\"", block.path);
    const std::filesystem::path found = find_beside(file, block.path);
    std::string fault;
    if (found.empty())
        fault = "is not beside the drawing as DXF; save it there, or bind it";
    else if (std::find(open_.begin(), open_.end(), found) != open_.end())
        fault = "leads back to a drawing that it is part of";
    else if (files_ >= most_files || open_.size() >= deepest)
        fault = fmt::format("is one too many: more than {} files or {} levels", most_files, deepest);
    if (fault.empty()) {
        const std::size_t depth = open_.size();
        try {
            Absorber{drawing, read(found), reference_name(drawing, index)}.absorb(block);
            return;
        } catch (const InputError& error) {
            open_.resize(depth);
            fault = std::string{"cannot be read: "} + error.what();
        }
    }
    report_.add(Finding::unsupported, place, said + " " + fault);
}

} // namespace

Drawing read_drawing_with_references(const std::filesystem::path& file, Report& report)
{
    return ReferenceReader{report}.read(file);
}

} // namespace lightwell::dxf
