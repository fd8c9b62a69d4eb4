#pragma once

#include "importers/export/dxf_tags.h"
#include "importers/export/export.h"
#include "importers/export/faces.h"

#include <optional>

namespace lightwell {

struct DxfBlock {
    std::string name;
    std::string record; ///< handle of its record, which owns its entities
};

/// Writes the surfaces of parts as entities.
class DxfEntities {
public:
    /// @param blocks  model space, paper space, then one for each prototype
    DxfEntities(const Imported& model, const std::vector<DxfBlock>& blocks, const ExportOptions& options,
                Report& report, DxfTags& tags)
        : model_(model), blocks_(blocks), options_(options), report_(report), tags_(tags)
    {
        find_layers_by_insert();
    }
    /// @param part  nullptr for the spaces, which are empty in the section BLOCKS
    void write_block(const Part* part, const DxfBlock& block);
    void write_part(const Part& part, const std::string& owner);

private:
    void write_entity(const Part& part, std::size_t first, std::size_t last);
    bool write_circle(const Part& part, std::size_t first, std::size_t last);
    void write_faces(const std::vector<Face>& faces, ModifierId modifier);
    void write_mesh(const std::vector<Face>& faces, ModifierId modifier);
    void write_ring(const Ring& ring, ModifierId modifier);
    void write_cylinder(const Cone& cone, bool inwards, ModifierId modifier);
    /// A circle, or an arc, drawn with a width or a thickness.
    struct Drawn {
        double radius, width, thickness;
        bool clockwise; ///< its front looks to the centre
    };
    void write_turned_polyline(const Point& centre, const Direction& normal, const Sector& sector, const Drawn& drawn,
                               ModifierId modifier);
    void write_instance(const Instance& instance);
    void write_out(const Instance& instance, const Affine& outer, const std::vector<Binding>& bindings);
    void find_layers_by_insert();
    /// Layer and colour that the entities of a block take from its insert; nothing when they want several.
    std::optional<ModifierId> style_of(const Instance& instance) const;
    /// Type, handle, layer and colour.
    void begin(const char* type, ModifierId modifier);

    const Imported& model_;
    const std::vector<DxfBlock>& blocks_;
    const ExportOptions& options_;
    Report& report_;
    DxfTags& tags_;
    std::vector<bool> layer_by_insert_; ///< place-holders whose layer the instances decide
    std::string owner_;
};

} // namespace lightwell
