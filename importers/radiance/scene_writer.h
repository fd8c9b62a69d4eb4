#pragma once

#include "importers/radiance/material_text.h"
#include "importers/radiance/modifier_table.h"
#include "importers/radiance/radiance.h"
#include "materials/patterns/place_function.h"

#include <deque>
#include <fstream>
#include <functional>
#include <map>
#include <set>

namespace lightwell::scene_text {

/// Text on its way to a file, in pieces of a megabyte.
class TextFile {
public:
    explicit TextFile(const std::filesystem::path& path) : stream_(path, std::ios::binary) {}
    std::string& text() { return text_; }
    /// Hands the text on when enough has come together.
    void pass_on();
    /// @throws std::runtime_error when the disk is full or cannot be written
    void close();

private:
    std::ofstream stream_;
    std::string text_;
};

/// Writes one scene: the file itself, and unless flat the parts that it repeats.
class SceneWriter {
public:
    SceneWriter(const Scene& scene, const std::filesystem::path& file, const WriteOptions& options, Report& report);
    void write();
    /// All modifiers, views and grids as text; after each modifier a line `#@is WORD`, in their order.
    std::string modifiers_text();

private:
    using Bindings = std::vector<Binding>;
    /// A prototype as it looks under certain bindings; each is one file.
    struct Variant {
        std::uint32_t prototype;
        Bindings bindings;
        std::string stem;
    };
    /// One file that is being written and the names that are defined in it so far.
    struct Output {
        TextFile file;
        std::map<std::string, ModifierId> defined = {};
        ModifierId last = void_modifier; ///< consecutive surfaces mostly share theirs
        std::string last_word = "void";
        std::set<ModifierId> busy = {}; ///< being defined: stops circles of `illum` alternates
    };
    /// Where the surfaces of a part go.
    struct Place {
        Affine map;
        bool expanded = false; ///< the part is written out in another frame
        const Bindings& bindings;
        std::string prefix = {};
    };

    void study_prototypes();
    void write_root(const std::filesystem::path& path);
    void write_parts();
    void write_variant(const Variant& variant, const std::filesystem::path& path);
    void write_build_script() const;
    void append_head(std::string& text) const;
    void append_views_and_grids(std::string& text) const;

    void write_part(Output& out, const Part& part, const Place& place);
    void write_surface(Output& out, const Part& part, const Surface& surface, const Place& place);
    void write_instance(Output& out, const Instance& instance, const std::string& name, const Place& place);
    void write_mesh(Output& out, const Part& part, const Surface& surface, ModifierId modifier, const std::string& name,
                    const Affine& map);
    void write_triangles(Output& out, const Mesh& mesh, ModifierId modifier, const std::string& name,
                         const Affine& map);
    /// Makes sure that the modifier's name means it from here on, and returns the word for it.
    const std::string& use(Output& out, ModifierId id);
    void define(Output& out, ModifierId id);
    scene_text::FileWords file_words(const PatternText& read, const std::string& name);
    void define_varying(Output& out, const Modifier& modifier, const Varying& varying);

    Bindings effective_bindings(std::uint32_t prototype, const Bindings& own, const Bindings& outer) const;
    bool sends_light(ModifierId modifier) const;
    std::string stem_of(const std::string& name);
    std::string stem_of_variant(std::uint32_t prototype, const Bindings& bindings);
    std::string write_mesh_file(const Mesh& mesh, const std::string& name);
    std::string data_file_of(const PatternText& pattern, const std::string& text, const std::string& name);
    std::string in_parts_folder(const std::string& file_name) const;

    const Scene& scene_;
    std::filesystem::path file_, parts_;
    WriteOptions options_;
    Report& report_;
    Scene changed_; ///< only modifiers: the scene's, and those that expansion turns
    ModifierTable table_;
    std::vector<std::set<ModifierId>> inherits_; ///< for each prototype, the place-holders left open in it
    std::vector<char> lit_;                      ///< for each prototype, whether it holds emitters or mirrors
    std::deque<Variant> variants_;
    std::map<std::pair<std::uint32_t, std::vector<std::pair<ModifierId, ModifierId>>>, std::string> variant_stems_;
    std::map<const Mesh*, std::string> mesh_stems_;        ///< of the scene's own meshes
    std::map<const PatternText*, std::string> data_stems_; ///< of patterns whose data are in no file yet
    std::vector<std::string> meshes_;                      ///< every mesh file written, in order
    std::set<std::string> stems_;
};

} // namespace lightwell::scene_text
