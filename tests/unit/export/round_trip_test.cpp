#include "engine/base/errors.h"
#include "importers/export/export.h"
#include "importers/export/faces.h"
#include "importers/formats/formats.h"
#include "importers/layers.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace lightwell {
namespace {

/// Each case writes and reads two or three files; so many find what goes wrong in a few seconds. RC_PARAMS asks for
/// more.
[[maybe_unused]] const int cases_asked_for = setenv("RC_PARAMS", "max_success=25", 0);

/// A folder of this process, removed at the end.
class Folder {
public:
    Folder() : path_(std::filesystem::path(testing::TempDir()) / ("export-" + std::to_string(getpid())))
    {
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Imported round(const Imported& model, const std::string& name) const
    {
        // A file that takes the place of another is flushed to the disk first, which may be busy.
        for (const auto& entry : std::filesystem::directory_iterator(path_))
            std::filesystem::remove_all(entry);
        Report report;
        export_file(model, path_ / name, {}, report);
        ImportOptions as_written;
        as_written.keep_triangles = true;
        return import_file(path_ / name, as_written);
    }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

double number(double low, double high)
{
    return low + (high - low) * (*rc::gen::inRange(0, 1 << 30)) / (1 << 30);
}

Affine turned()
{
    return compose(compose(Affine::rotate(2, number(-3, 3)), Affine::rotate(0, number(-3, 3))),
                   Affine::rotate(2, number(-3, 3)));
}

/// A model by chance: outlines, discs and capped cylinders in the open and in blocks, which are placed any way that a
/// drawing can say.
class Model {
public:
    /// @param most_corners  of an outline
    explicit Model(int most_corners, bool with_round) : most_corners_(most_corners), with_round_(with_round) {}
    Imported make()
    {
        const double far = *rc::gen::element(0.0, 100.0, 1e6);
        KeyTable keys{model_};
        const ModifierId walls = keys.modifier_for(key("A-WALL")), lamps = keys.modifier_for(key("Lampen 2. OG"));
        fill(model_.scene.root, walls, {far, -far, 3});
        fill(model_.scene.root, lamps, {far, far, 0});
        const ModifierId waiting = keys.inherited(key("0"));
        const ModifierId own = keys.modifier_for(key("Möbel"));
        Part chair;
        chair.name = "CHAIR";
        fill(chair, waiting, {});
        fill(chair, own, {});
        model_.scene.prototypes = {chair};
        const int copies = *rc::gen::inRange(1, 4);
        for (int i = 0; i < copies; ++i) {
            Affine map =
                compose(turned(), Affine::scale(*rc::gen::element(Vec3{1, 1, 1}, Vec3{-1, 1, 1}, Vec3{2, 2, 2})));
            map.translation = {far + i, number(-50, 50), number(0, 10)};
            const ModifierId layer = keys.modifier_for(key(*rc::gen::element("A-FURN", "I-FURN")));
            model_.scene.root.add_instance({0, map, {{waiting, layer}}}, next_name());
        }
        return std::move(model_);
    }

private:
    static SurfaceKey key(const std::string& layer)
    {
        SurfaceKey key;
        key.layer = layer;
        key.entity = "3DFACE";
        key.colour = Spectrum{srgb_to_linear(*rc::gen::inRange(0, 256) / 255.0), 1, 0};
        return key;
    }
    std::string next_name() { return std::to_string(++names_); }

    void fill(Part& part, ModifierId modifier, const Vec3& offset)
    {
        const int outlines = *rc::gen::inRange(1, 4);
        for (int i = 0; i < outlines; ++i)
            part.add_polygon(outline(offset), modifier, next_name());
        if (with_round_)
            add_round(part, modifier, offset);
    }
    /// Corners about a circle, at different distances from its middle: often concave.
    std::vector<Point> outline(const Vec3& offset)
    {
        const Affine map = turned();
        const int corners = *rc::gen::inRange(3, most_corners_ + 1);
        const double size = *rc::gen::element(0.01, 1.0, 20.0);
        std::vector<Point> points;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * pi * i / corners, radius = size * number(0.5, 1);
            points.push_back(map.point(Point{radius * std::cos(angle), radius * std::sin(angle), 0}) + offset);
        }
        return points;
    }
    void add_round(Part& part, ModifierId modifier, const Vec3& offset)
    {
        const Affine map = turned();
        const double radius = number(0.1, 5), height = number(0.1, 5);
        const Point foot = offset + Vec3{number(-5, 5), number(-5, 5), 0};
        const std::string column = next_name();
        const Point head = foot + map.z * height;
        part.add_cone({{foot, head}, {radius, radius}}, Shape::cylinder, modifier, column);
        part.add_ring({foot, -map.z, 0, radius}, modifier, column);
        part.add_ring({head, map.z, 0, radius}, modifier, column);
        part.add_ring({foot, map.x, radius / 3, radius}, modifier, next_name());
        part.add_ring({head, map.y, 0, radius}, modifier, next_name());
        part.add_cone({{head, foot}, {radius, radius}}, Shape::cylinder, modifier, next_name());
        const auto sector = [&](const Vec3& start) { return Sector{start, number(0.1, 6)}; };
        part.add_cone({{foot, head}, {radius, radius}, sector(map.x)}, Shape::cylinder, modifier, next_name());
        part.add_cone({{foot, head}, {radius, radius}, sector(map.y)}, Shape::tube, modifier, next_name());
        part.add_ring({foot, map.x, radius / 3, radius, sector(map.y)}, modifier, next_name());
    }

    Imported model_;
    const int most_corners_;
    const bool with_round_;
    int names_ = 0;
};

/// A surface in the world: layer, shape, and points that say where it is.
struct Seen {
    std::string layer;
    Shape shape;
    std::vector<Point> points;
};

/// Both ends of an arc, whichever comes first, and its middle.
void add_rim(Seen& seen, const Sector& sector, const Direction& axis, const Point& centre, double radius,
             const Affine& map)
{
    if (sector.is_whole())
        return;
    const Frame frame = sector_frame(sector, axis);
    const auto at = [&](double share) {
        const double angle = share * sector.sweep_rad;
        return map.point(centre + (frame.x * std::cos(angle) + frame.y * std::sin(angle)) * radius);
    };
    seen.points.push_back(at(0) * 0.5 + at(1) * 0.5);
    seen.points.push_back(at(0.5));
    seen.points.push_back(at(map.determinant() < 0 ? 1 : 0));
}

std::vector<Seen> seen_in(const Imported& model)
{
    std::vector<Seen> list;
    visit_expanded(model.scene, [&](const Part& part, const Surface& surface, const Affine& map, ModifierId modifier) {
        Seen seen{model.keys.at(static_cast<std::size_t>(modifier)).layer, surface.shape, {}};
        const double scale = similarity_scale(map);
        if (surface.shape == Shape::polygon) {
            const Polygon& polygon = part.polygons[surface.index];
            for (std::uint32_t i = 0; i < polygon.count; ++i)
                seen.points.push_back(map.point(part.points[polygon.first + i]));
        } else if (surface.shape == Shape::cylinder || surface.shape == Shape::tube) {
            const Cone& cone = part.cones[surface.index];
            seen.points = {map.point(cone.ends[0]), map.point(cone.ends[1]), {scale * cone.radii[0], 0, 0}};
            add_rim(seen, cone.sector, normalized(cone.ends[1] - cone.ends[0]), cone.ends[0], cone.radii[0], map);
        } else if (surface.shape == Shape::ring) {
            const Ring& ring = part.rings[surface.index];
            seen.points = {map.point(ring.centre),
                           map.point(ring.centre) + transform_normal(map, ring.normal),
                           {scale * ring.inner_radius, scale * ring.outer_radius, 0}};
            add_rim(seen, ring.sector, ring.normal, ring.centre, ring.outer_radius, map);
        }
        list.push_back(std::move(seen));
    });
    return list;
}

/// The same surfaces in the same order, coordinates within a tolerance of the largest one.
void expect_same(const std::vector<Seen>& wanted, const std::vector<Seen>& found, double tolerance)
{
    RC_ASSERT(found.size() == wanted.size());
    double largest = 1;
    for (const Seen& seen : wanted)
        for (const Point& point : seen.points)
            largest = std::fmax(largest, max_abs(point));
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        RC_ASSERT(found[i].layer == wanted[i].layer);
        RC_ASSERT(found[i].shape == wanted[i].shape);
        RC_ASSERT(found[i].points.size() == wanted[i].points.size());
        for (std::size_t k = 0; k < wanted[i].points.size(); ++k)
            RC_ASSERT(max_abs(found[i].points[k] - wanted[i].points[k]) <= tolerance * largest);
    }
}

std::map<std::pair<std::string, std::string>, std::size_t> made_in(const Imported& model)
{
    std::map<std::pair<std::string, std::string>, std::size_t> counts;
    for (const Ledger::Made& entry : model.ledger.made_list())
        counts[{entry.layer, entry.type}] += entry.count;
    return counts;
}

std::map<std::string, std::size_t> made_by_type(const Imported& model)
{
    std::map<std::string, std::size_t> counts;
    for (const Ledger::Made& entry : model.ledger.made_list())
        counts[entry.type] += entry.count;
    return counts;
}

/// Whether the reader of DXF takes the faces of a MESH, which is how outlines of more than four corners are written.
bool reads_meshes(const Folder& folder)
{
    Imported pentagon;
    KeyTable keys{pentagon};
    SurfaceKey key;
    key.layer = "A";
    pentagon.scene.root.add_polygon({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {0, 1, 0}}, keys.modifier_for(key),
                                    "p");
    return folder.round(pentagon, "pentagon.dxf").ledger.made_count() == 1;
}

TEST(RoundTrip, ThroughDxfKeepsSurfacesTo1e12AndTheLedger)
{
    const Folder folder;
    const int most_corners = reads_meshes(folder) ? 9 : 4;
    EXPECT_TRUE(rc::check("model -> DXF -> model", [&] {
        const Imported model = Model{most_corners, true}.make();
        const Imported again = folder.round(model, "model.dxf");
        expect_same(seen_in(model), seen_in(again), 1e-12);
        RC_ASSERT(again.ledger.skipped_list().empty());
        const Imported third = folder.round(again, "model.dxf");
        RC_ASSERT(made_by_type(third) == made_by_type(again));
        RC_ASSERT(third.scene.prototypes.size() == again.scene.prototypes.size());
        expect_same(seen_in(again), seen_in(third), 1e-12);
        // The reader gives blocks whose inserts agree the layer of those inserts: from then on all stays as it is.
        const Imported fourth = folder.round(third, "model.dxf");
        RC_ASSERT(made_in(fourth) == made_in(third));
        expect_same(seen_in(third), seen_in(fourth), 1e-12);
    }));
}

TEST(RoundTrip, ThroughObjKeepsOutlinesTo1e9AndTheLedger)
{
    const Folder folder;
    EXPECT_TRUE(rc::check("model -> OBJ -> model", [&] {
        const Imported model = Model{9, false}.make();
        std::vector<Seen> wanted = seen_in(model);
        std::size_t at = 0;
        visit_expanded(model.scene, [&](const Part&, const Surface&, const Affine& map, ModifierId) {
            if (map.determinant() < 0) // the front stays the front
                std::reverse(wanted[at].points.begin(), wanted[at].points.end());
            ++at;
        });
        const Imported again = folder.round(model, "model.obj");
        expect_same(wanted, seen_in(again), 1e-9);
        RC_ASSERT(again.ledger.skipped_list().empty());
        const Imported third = folder.round(again, "model.obj");
        RC_ASSERT(made_in(third) == made_in(again));
        expect_same(seen_in(again), seen_in(third), 0);
    }));
}

TEST(RoundTrip, ThroughGlbKeepsAreasAndBoundsToSinglePrecisionAndTheLedger)
{
    const Folder folder;
    const auto layers_agree = [](const Imported& a, const Imported& b) {
        const auto wanted = summarize_layers(a), found = summarize_layers(b);
        RC_ASSERT(found.size() == wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            RC_ASSERT(found[i].name == wanted[i].name);
            RC_ASSERT(std::fabs(found[i].area_m2 - wanted[i].area_m2) <= 1e-5 * wanted[i].area_m2);
        }
        const Box box = bounds(a.scene), again = bounds(b.scene);
        // Boxes of turned instances are those about their boxes' corners: compare where they are, roughly.
        RC_ASSERT(length(box.centre() - again.centre()) <= 0.6 * box.diagonal());
    };
    EXPECT_TRUE(rc::check("model -> GLB -> model", [&] {
        const Imported model = Model{9, false}.make();
        const Imported again = folder.round(model, "model.glb");
        layers_agree(model, again);
        const Imported third = folder.round(again, "model.glb");
        layers_agree(again, third);
        RC_ASSERT(third.ledger.made_count() == again.ledger.made_count());
    }));
}

/// A side and its caps, along any axis: as facets they hang together by the same corners, so that a lamp stays closed.
TEST(Export, ARoundBodyIsClosedAsFacets)
{
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -2}, Vec3{0.6, 0, -0.8}}) {
        SCOPED_TRACE(axis.x);
        const Point foot{1, 2, 3}, head = foot + axis;
        const Direction up = normalized(head - foot);
        Part part;
        part.add_cone({{foot, head}, {0.1, 0.1}}, Shape::cylinder, void_modifier, "side");
        part.add_ring({foot, -up, 0, 0.1}, void_modifier, "bottom");
        part.add_ring({head, up, 0, 0.1}, void_modifier, "top");
        std::map<std::array<double, 6>, int> edges; // from one corner to another, less those the other way
        for (const Surface& surface : part.surfaces) {
            bool approximated = false;
            for (const auto& face : faces_of(part, surface, 1e-3, approximated))
                for (std::size_t i = 0; i < face.size(); ++i) {
                    const Point a = face[i], b = face[(i + 1) % face.size()];
                    ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
                    --edges[{b.x, b.y, b.z, a.x, a.y, a.z}];
                }
        }
        EXPECT_TRUE(std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; }));
    }
}

TEST(Export, HostileNamesStayOneNameEach)
{
    const Folder folder;
    Imported model;
    KeyTable keys{model};
    for (const char* layer : {"two words", "line\nbreak", "#hash", "back\\", "墙", "default"}) {
        SurfaceKey key;
        key.layer = layer;
        model.scene.root.add_polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, keys.modifier_for(key), layer);
    }
    for (const char* name : {"names.dxf", "names.obj", "names.glb"})
        EXPECT_EQ(summarize_layers(folder.round(model, name)).size(), 6u) << name;
}

TEST(Export, PicturesOfMaterialsLeaveTheirMeanAndANote)
{
    const Folder folder;
    const Imported model = import_file(LIGHTWELL_ROOT "/tests/fixtures/gltf/looks.glb", {});
    Report report;
    export_file(model, folder / "looks.obj", {}, report);
    const auto& notes = report.notes();
    const auto said = std::find_if(notes.begin(), notes.end(), [](const Note& note) {
        return note.text.find("pictures on surfaces are not written") != std::string::npos;
    });
    ASSERT_NE(said, notes.end());
    EXPECT_EQ(said->count, 3u); // Pictured: colour and normals; Holes
    const Imported again = import_file(folder / "looks.obj", {});
    const auto pictured = std::find_if(again.file_materials.begin(), again.file_materials.end(),
                                       [](const auto& own) { return own.first == "Pictured"; });
    ASSERT_NE(pictured, again.file_materials.end());
    EXPECT_NEAR(to_rec709(std::get<Plastic>(pictured->second).colour).g, 0.502886, 0.03); // sRGB 188, under a varnish
}

TEST(Export, AnEmptyModelAndAnUnknownEndingAreAnswered)
{
    const Folder folder;
    Report report;
    EXPECT_NO_THROW(export_file({}, folder / "empty.dxf", {}, report));
    EXPECT_EQ(import_file(folder / "empty.dxf").ledger.read_count(), 0u);
    EXPECT_NO_THROW(export_file({}, folder / "empty.obj", {}, report));
    EXPECT_NO_THROW(export_file({}, folder / "empty.glb", {}, report));
    try {
        export_file({}, folder / "model.step", {}, report);
        FAIL() << "no complaint";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("expected .dxf, .obj or .glb"), std::string::npos) << error.what();
    }
    EXPECT_THROW(export_file({}, folder / "no/such/folder.dxf", {}, report), InputError);
}

TEST(Export, ShearedInstancesAndSpheresAreWrittenOutAndTold)
{
    const Folder folder;
    Imported model;
    KeyTable keys{model};
    SurfaceKey key;
    key.layer = "A";
    Part part;
    part.name = "B";
    part.add_polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, keys.modifier_for(key), "p");
    model.scene.prototypes = {part};
    model.scene.root.add_instance({0, {{1, 0, 0}, {0.5, 1, 0}, {0, 0, 1}, {}}, {}}, "sheared");
    Report report;
    export_file(model, folder / "sheared.dxf", {}, report);
    EXPECT_TRUE(report.has(Finding::approximated));
    const Imported again = import_file(folder / "sheared.dxf");
    EXPECT_NEAR(summarize_layers(again).at(0).area_m2, 1, 1e-12);
    EXPECT_NEAR(bounds(again.scene).high.x, 1.5, 1e-12);
}

} // namespace
} // namespace lightwell
