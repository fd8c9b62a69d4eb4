#pragma once

#include "importers/radiance/compiled_scene.h"
#include "importers/radiance/inline_commands.h"
#include "importers/radiance/modifier_table.h"
#include "importers/radiance/ply_part.h"
#include "importers/radiance/read_options.h"
#include "importers/radiance/transform_words.h"
#include "importers/radiance/words.h"
#include "materials/patterns/pattern_reader.h"

#include <filesystem>
#include <map>
#include <memory>
#include <utility>

namespace lightwell::scene_text {

/// Reads one scene: the first file and every file that it refers to.
class SceneReader {
public:
    SceneReader(const std::filesystem::path& file, Report& report, KeptMeshes& kept, SceneOrigins& origins,
                const RadianceReadOptions& options);
    Scene read();
    NamedScene read_sources(const std::vector<SceneSource>& sources);

private:
    /// A file that is being read; the chain of them leads back to the first.
    struct OpenFile {
        const OpenFile* from;
        std::filesystem::path path; ///< canonical
        Words words;
        int depth = 0;                  ///< files and outputs of commands around it
        std::string last_modifier = {}; ///< consecutive surfaces mostly share theirs
        Meaning last_meaning = {};
        bool last_known = false;
        bool sharp_horizon = false; ///< of the next sky
        /// While files are included by `!xform -m`: what their surfaces are made of, whatever they name.
        std::optional<Meaning> included_as = {};
        /// Prototypes of the files that its instances name: spares the search for each of a million instances.
        std::unordered_map<std::string, std::uint32_t, NameHash, std::equal_to<>> instances = {};
    };
    /// Where primitives go: the part that is being filled and the names that are known.
    struct Target {
        Part& part;
        Scope& scope;
        bool first_file = false; ///< views and grids count
        bool own_part = true;    ///< the part is this file's, which may say what it is called
    };
    /// Files included with a transform, read once in their own frame and then placed again and again.
    struct Fragment {
        Part part;                              ///< empty when it became a prototype
        std::optional<std::uint32_t> prototype; ///< set when it is shared by instances
        std::unique_ptr<Scope> scope;
        bool turns = false, scales = false; ///< has beams, skies or distant sources; materials that know lengths
        std::set<ModifierId> outside = {};  ///< patterns of the text around it, which do not move along
    };
    /// What a problem a name has when it is used.
    struct Problem {
        std::string place, what, hint;
    };
    struct Xform {
        std::vector<Placement> placements;
        std::optional<std::string> name, modifier;
        std::vector<std::filesystem::path> files;
        bool plain = false; ///< nothing but the files
    };

    void read_file(const std::filesystem::path& path, const OpenFile* from, const std::string& place, Target target);
    /// @param path  where the text's references are looked for; `name` is for messages
    void read_text(std::string_view text, const std::filesystem::path& path, const std::string& name,
                   const OpenFile* from, Target target);
    /// A compiled scene in the place of text; its names become known.
    void read_compiled(std::string_view bytes, const std::filesystem::path& path, const std::string& name,
                       const OpenFile* from, Target target);
    void read_primitive(OpenFile& file, Primitive& primitive, Target target);
    /// What `#@from` named is where the surfaces of the primitive after it come from.
    void note_object(std::size_t first_surface);
    void read_comment(OpenFile& file, std::string_view comment, Target target);
    void read_grid(const std::string& place, const std::vector<std::string_view>& fields);

    // modifiers
    void define(OpenFile& file, const Primitive& primitive, Target target);
    void define_alias(OpenFile& file, const Primitive& primitive, Target target);
    void define_pattern(OpenFile& file, const Primitive& primitive, const Meaning& parent, Target target);
    void define_varying(OpenFile& file, const Primitive& primitive, const Meaning& parent, Target target);
    PatternReader::Request request(const OpenFile& file, const Primitive& primitive, std::size_t first_word,
                                   const std::string& place) const;
    std::shared_ptr<const PlaceFunction> pattern_function(const OpenFile& file, const Primitive& primitive,
                                                          std::size_t mixed_words, const std::string& place);
    ModifierId aliased(const std::string& name, ModifierId target, const std::optional<ModifierId>& parent);
    ModifierId moved_patterns(ModifierId modifier, const Affine& map, const std::string& place);
    void check_material(Material& material, const Meaning& parent, const std::string& place);
    void define_material(OpenFile& file, const Primitive& primitive, Meaning parent, Target target);
    Meaning problem(const std::string& place, const std::string& what, const std::string& hint = {});
    Meaning meaning_of(OpenFile& file, const Primitive& primitive, std::string_view name, Target target);
    ModifierId usable(OpenFile& file, const Primitive& primitive, const Meaning& meaning);

    // references to other files
    void add_instance(OpenFile& file, const Primitive& primitive, Target target);
    void add_mesh(OpenFile& file, const Primitive& primitive, Target target);
    std::uint32_t prototype_of_file(const std::filesystem::path& path, OpenFile& file, const std::string& place);
    std::uint32_t prototype_with_materials(const std::filesystem::path& path, OpenFile& file, const std::string& place);
    std::uint32_t prototype_of_mesh(const std::filesystem::path& path, ModifierId modifier);
    std::uint32_t add_prototype(Part part);
    std::uint32_t with_modifier(std::uint32_t prototype, ModifierId modifier);
    std::shared_ptr<const Mesh> mesh(const std::filesystem::path& path);
    void add_ply(OpenFile& file, const Primitive& primitive, const std::filesystem::path& path, Target target);
    std::vector<ModifierId> ply_modifiers(const PlyPart& built, OpenFile& file, const Primitive& primitive,
                                          Target target);
    std::uint32_t prototype_of_ply(const std::shared_ptr<const PlyPart>& built, const std::vector<ModifierId>& ids,
                                   const std::string& place);
    std::filesystem::path find(const std::string& name, const OpenFile& file, const std::string& place) const;
    std::optional<std::filesystem::path> find_quietly(const std::filesystem::path& wanted, const OpenFile& file) const;

    // !xform
    void run(OpenFile& file, const std::string& command, const std::string& place, Target target);
    std::vector<Xform> parse_xform(const std::vector<std::string>& words, const OpenFile& file,
                                   const std::string& place) const;
    Xform parse_one_xform(const std::vector<std::string>& words, const OpenFile& file, const std::string& place) const;
    void include(const Xform& xform, OpenFile& file, const std::string& place, Target target);
    Fragment& fragment(const std::vector<std::filesystem::path>& files, OpenFile& file, const std::string& place,
                       Target target);
    void describe(Fragment& fragment) const;
    void place_fragment(Fragment& fragment, const Placement& placement, const std::string& prefix,
                        const std::optional<ModifierId>& modifier, const std::string& place, Target target);
    void expand(const Fragment& fragment, const Part& part, const Affine& map, const std::string& prefix,
                const std::optional<ModifierId>& modifier, const std::string& place, Part& to);
    const Part& part_of(const Fragment& fragment) const;

    std::filesystem::path first_file_;
    Report& report_;
    KeptMeshes& kept_;
    SceneOrigins& origins_;
    CommandPolicy policy_;
    std::set<std::filesystem::path> files_;               ///< that were read
    std::vector<ModifierId>* listed_modifiers_ = nullptr; ///< those of the compiled scene that is being read
    Scene scene_;
    ModifierTable table_;
    Scope scope_;
    PatternReader patterns_;
    std::vector<Problem> problems_;
    std::vector<std::pair<bool, bool>> prototype_changes_; ///< for each prototype: Fragment's turns and scales
    std::map<std::filesystem::path, std::uint32_t> file_prototypes_;
    std::map<std::pair<std::filesystem::path, ModifierId>, std::uint32_t> mesh_prototypes_;
    std::map<std::pair<std::uint32_t, ModifierId>, std::uint32_t> remade_prototypes_;
    std::map<std::pair<std::shared_ptr<const PlyPart>, std::vector<ModifierId>>, std::uint32_t> ply_prototypes_;
    std::set<const PlyPart*> ply_noted_; ///< whose notes are in the report
    std::string object_;                 ///< that the next surface of the root comes from
    std::map<std::filesystem::path, std::shared_ptr<const Mesh>> meshes_;
    std::map<std::vector<std::filesystem::path>, std::vector<std::unique_ptr<Fragment>>> fragments_;
    std::size_t expanded_ = 0; ///< surfaces that transforms have copied
};

/// The one placement of an `instance`, `mesh` or `subdivision` line.
Affine only_placement(const Primitive& primitive, const std::string& place);

} // namespace lightwell::scene_text
