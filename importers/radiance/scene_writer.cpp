#include "importers/radiance/scene_writer.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/text.h"
#include "engine/scene/expansion.h"
#include "importers/radiance/words.h"

#include <algorithm>
#include <fmt/format.h>

namespace lightwell {

void write_radiance(const Scene& scene, const std::filesystem::path& file, const WriteOptions& options, Report& report)
{
    scene_text::SceneWriter(scene, file, options, report).write();
}

namespace scene_text {
namespace {

/// A flat file with more surfaces than this (some ten gigabytes) is not what anybody wants.
constexpr std::size_t most_flat_surfaces = 50'000'000;

} // namespace

void TextFile::pass_on()
{
    constexpr std::size_t enough = 1 << 20;
    if (text_.size() < enough)
        return;
    stream_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
}

void TextFile::close()
{
    stream_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    stream_.close();
    if (!stream_)
        throw std::runtime_error("the disk is full or cannot be written");
}

SceneWriter::SceneWriter(const Scene& scene, const std::filesystem::path& file, const WriteOptions& options,
                         Report& report)
    : scene_(scene), file_(file), parts_(file.parent_path() / (file.stem().string() + ".parts")), options_(options),
      report_(report), changed_{scene.modifiers, {}, {}, {}, {}}, table_(changed_)
{
}

void SceneWriter::write()
{
    if (!(options_.chord_tolerance_m > 0 && std::isfinite(options_.chord_tolerance_m)))
        throw InputError{file_.string(),
                         fmt::format("chord tolerance is {} m, expected > 0", options_.chord_tolerance_m)};
    if (options_.flat && expanded_count(scene_) > most_flat_surfaces)
        throw InputError{file_.string(),
                         fmt::format("the scene has {} surfaces when instances are written out, more than {}",
                                     expanded_count(scene_), most_flat_surfaces),
                         "write it with instances"};
    study_prototypes();
    write_atomically(file_, [&](const std::filesystem::path& path) {
        write_root(path);
        write_parts();
    });
}

std::string SceneWriter::modifiers_text()
{
    Output out{TextFile({})};
    append_views_and_grids(out.file.text());
    for (std::size_t i = 0; i < scene_.modifiers.size(); ++i) {
        const std::string word = use(out, static_cast<ModifierId>(i));
        out.file.text() += "#@is " + word + '\n';
    }
    return std::move(out.file.text());
}

void SceneWriter::study_prototypes()
{
    for (const Part& part : scene_.prototypes) {
        std::set<ModifierId> inherited;
        bool lit = !part.sources.empty();
        for (const Surface& surface : part.surfaces) {
            if (surface.shape == Shape::instance || surface.modifier == void_modifier)
                continue;
            const auto& what = scene_.modifiers[static_cast<std::size_t>(surface.modifier)].what;
            if (std::holds_alternative<Inherited>(what))
                inherited.insert(surface.modifier);
            lit = lit || sends_light(surface.modifier);
        }
        for (const Instance& instance : part.instances) {
            lit = lit || lit_[instance.prototype] != 0;
            for (const ModifierId open : inherits_[instance.prototype]) {
                const ModifierId bound = bound_modifier(scene_, open, instance.bindings);
                lit = lit || sends_light(bound);
                if (bound != void_modifier &&
                    std::holds_alternative<Inherited>(scene_.modifiers[static_cast<std::size_t>(bound)].what))
                    inherited.insert(bound);
            }
        }
        inherits_.push_back(std::move(inherited));
        lit_.push_back(lit ? 1 : 0);
    }
}

bool SceneWriter::sends_light(ModifierId modifier) const
{
    const ResolvedMaterial resolved = resolve(scene_, modifier);
    if (resolved.material == nullptr)
        return false;
    return is_emitter(*resolved.material) || std::holds_alternative<Mirror>(*resolved.material);
}

SceneWriter::Bindings SceneWriter::effective_bindings(std::uint32_t prototype, const Bindings& own,
                                                      const Bindings& outer) const
{
    Bindings effective;
    for (const ModifierId open : inherits_[prototype]) {
        const ModifierId bound = bound_modifier(scene_, bound_modifier(scene_, open, own), outer);
        if (bound != open)
            effective.push_back({open, bound});
    }
    return effective;
}

void SceneWriter::append_head(std::string& text) const
{
    text += "# Scene text written by Lightwell; lengths in metres, z up\n";
    if (options_.flat)
        text += "# flat: every instance is written out\n";
    else if (!scene_.prototypes.empty() || !scene_.root.meshes.empty())
        text += "# Repeated parts and meshes are in " + parts_.filename().string() +
                ", which Lightwell reads as text.\n# Other programs want them compiled: run `sh " +
                (parts_.filename() / "build.sh").string() + "` in this folder first.\n";
    if (!scene_.root.name.empty())
        text += "#@from " + percent_encoded(scene_.root.name) + '\n';
}

void SceneWriter::append_views_and_grids(std::string& text) const
{
    for (const View& view : scene_.views)
        text += "#@view " + percent_encoded(view.name) + ' ' + to_text(view) + '\n';
    for (const SensorGrid& grid : scene_.grids) {
        text += fmt::format("#@grid {} {} {} {}\n", percent_encoded(grid.name), grid.rows, grid.columns,
                            shortest(grid.spacing_m));
        for (const Sensor& sensor : grid.sensors) {
            text += "#@grid-sensor";
            for (const Vec3& v : {sensor.position, sensor.normal})
                text += ' ' + shortest(v.x) + ' ' + shortest(v.y) + ' ' + shortest(v.z);
            text += '\n';
        }
        const auto columns = static_cast<std::size_t>(std::max(grid.columns, 1));
        for (std::size_t i = 0; i < grid.cells.size(); ++i) {
            text += i % columns == 0 ? "#@grid-cells " : " ";
            text += std::to_string(grid.cells[i]);
            if ((i + 1) % columns == 0 || i + 1 == grid.cells.size())
                text += '\n';
        }
    }
}

void SceneWriter::write_root(const std::filesystem::path& path)
{
    Output out{TextFile(path)};
    append_head(out.file.text());
    append_views_and_grids(out.file.text());
    for (std::size_t i = 0; i < scene_.modifiers.size(); ++i)
        use(out, static_cast<ModifierId>(i));
    const Bindings none;
    write_part(out, scene_.root, {Affine{}, false, none});
    out.file.close();
}

void SceneWriter::write_parts()
{
    if (variants_.empty() && meshes_.empty())
        return;
    // Writing a part may call for further parts, which join the end of the list.
    for (std::size_t i = 0; i < variants_.size(); ++i) {
        const Variant variant = variants_[i];
        write_atomically(parts_ / (variant.stem + ".rad"),
                         [&](const std::filesystem::path& path) { write_variant(variant, path); });
    }
    write_build_script();
}

void SceneWriter::write_variant(const Variant& variant, const std::filesystem::path& path)
{
    const Part& part = scene_.prototypes[variant.prototype];
    Output out{TextFile(path)};
    out.file.text() += "# Part of " + file_.filename().string() + ", written by Lightwell\n";
    out.file.text() += "#@from " + percent_encoded(part.name) + '\n';
    std::set<ModifierId> used;
    for (const Surface& surface : part.surfaces)
        if (surface.shape != Shape::instance)
            used.insert(bound_modifier(scene_, surface.modifier, variant.bindings));
    for (const ModifierId id : used)
        use(out, id);
    write_part(out, part, {Affine{}, false, variant.bindings});
    out.file.close();
}

void SceneWriter::write_build_script() const
{
    std::string text = "# Compiles the parts of " + file_.filename().string() +
                       " for programs that want it; run it in the folder of that file.\nset -e\n";
    const auto quoted = [&](const std::string& name) { return '"' + in_parts_folder(name) + '"'; };
    for (const std::string& stem : meshes_)
        text += "obj2mesh " + quoted(stem + ".obj") + ' ' + quoted(stem + ".rtm") + '\n';
    // A part refers only to prototypes before its own, so theirs are compiled first.
    std::vector<const Variant*> ordered;
    for (const Variant& variant : variants_)
        ordered.push_back(&variant);
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const Variant* a, const Variant* b) { return a->prototype < b->prototype; });
    for (const Variant* variant : ordered)
        text += "oconv -f " + quoted(variant->stem + ".rad") + " > " + quoted(variant->stem + ".oct") + '\n';
    write_text_atomically(parts_ / "build.sh", text);
}

std::string SceneWriter::in_parts_folder(const std::string& file_name) const
{
    return (parts_.filename() / file_name).string();
}

std::string SceneWriter::stem_of(const std::string& name)
{
    std::string plain;
    for (const char c : name) {
        const bool keep = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        plain += keep ? c : '_';
    }
    constexpr std::size_t longest = 60; // file systems allow 255 bytes with the ending
    plain = plain.empty() ? "part" : plain.substr(0, longest);
    // Some file systems take upper and lower case for the same.
    std::string stem = plain;
    for (int number = 2; !stems_.insert(lowercase_ascii(stem)).second; ++number)
        stem = plain + '-' + std::to_string(number);
    std::filesystem::create_directories(parts_);
    return stem;
}

std::string SceneWriter::stem_of_variant(std::uint32_t prototype, const Bindings& bindings)
{
    std::pair<std::uint32_t, std::vector<std::pair<ModifierId, ModifierId>>> key{prototype, {}};
    for (const Binding& binding : bindings)
        key.second.emplace_back(binding.inherited, binding.actual);
    const auto [entry, fresh] = variant_stems_.try_emplace(std::move(key));
    if (fresh) {
        entry->second = stem_of(scene_.prototypes[prototype].name);
        variants_.push_back({prototype, bindings, entry->second});
    }
    return entry->second;
}

} // namespace scene_text
} // namespace lightwell
