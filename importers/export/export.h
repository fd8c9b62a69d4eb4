#pragma once

#include "importers/importer.h"

#include <filesystem>

namespace lightwell {

struct ExportOptions {
    double chord_tolerance_m = 0.0005; ///< for round shapes that a format lacks
};

/// Writes a model as DXF (release 2013), with layers, colours, blocks and inserts: a corner triple or quadruple is a
/// 3DFACE, more faces of one entity and N-gons are a MESH, discs and rings are polylines with width, cylinders have a
/// thickness.
/// Error   coordinates exact; inserts and round shapes 1e-12 relative; maps that shear, cones and spheres are written
///         out as facets, with notes
/// @throws InputError when the folder is missing
void export_dxf(const Imported& model, const std::filesystem::path& file, const ExportOptions& options, Report& report);

/// Writes OBJ with its MTL beside it, in metres, z up: N-gons stay, instances are written out, round shapes become
/// facets.
/// Error   coordinates of what is not inside an instance exact
/// @throws InputError when the folder is missing, or more than fifty million faces would result
void export_obj(const Imported& model, const std::filesystem::path& file, const ExportOptions& options, Report& report);

/// Writes GLB: triangles, a node for each instance, `extras.layer` for layers, physically based materials.
/// Error   coordinates single precision relative to each mesh's middle, whose place is in double precision
/// @throws InputError when the folder is missing, or more than two million nodes would result
void export_glb(const Imported& model, const std::filesystem::path& file, const ExportOptions& options, Report& report);

/// Chooses by the ending: .dxf, .obj, .glb.
/// @throws InputError for any other
void export_file(const Imported& model, const std::filesystem::path& file, const ExportOptions& options,
                 Report& report);

} // namespace lightwell
