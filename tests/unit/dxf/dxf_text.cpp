#include "tests/unit/dxf/dxf_text.h"

#include "engine/base/errors.h"

#include <fstream>
#include <sstream>
#include <unistd.h>

namespace lightwell::test {
TemporaryFile::TemporaryFile(const std::string& content)
{
    static int number = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("lightwell_dxf_" + std::to_string(getpid()) + "_" + std::to_string(++number) + ".dxf");
    std::ofstream{path_, std::ios::binary} << content;
}

TemporaryFile::~TemporaryFile()
{
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

std::string tags(const std::string& pairs)
{
    std::istringstream in{pairs};
    std::string text, word;
    while (in >> std::ws && !in.eof()) {
        if (in.peek() == '"') {
            in.get();
            std::getline(in, word, '"');
        } else {
            in >> word;
        }
        text += word + '\n';
    }
    return text;
}

std::string drawing(const std::string& blocks, const std::string& entities, const std::string& tables)
{
    return tags("0 SECTION 2 HEADER 9 $INSUNITS 70 6 0 ENDSEC 0 SECTION 2 TABLES 0 TABLE 2 LAYER " + tables +
                " 0 ENDTAB 0 ENDSEC 0 SECTION 2 BLOCKS " + blocks + " 0 ENDSEC 0 SECTION 2 ENTITIES " + entities +
                " 0 ENDSEC 0 EOF");
}

Imported imported_text(const std::string& content, const ImportOptions& options)
{
    const TemporaryFile file{content};
    return import_dxf(file.path(), options);
}

std::string import_error(const std::string& content)
{
    const TemporaryFile file{content};
    try {
        import_dxf(file.path(), {});
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

std::map<std::string, LayerArea> layer_areas(const Imported& imported)
{
    std::map<std::string, LayerArea> layers;
    visit_expanded(imported.scene, [&](const Part& part, const Surface& surface, const Affine& map, ModifierId id) {
        LayerArea& layer = layers[imported.keys.at(static_cast<std::size_t>(id)).layer];
        ++layer.surfaces;
        if (surface.shape == Shape::polygon) {
            const Polygon& polygon = part.polygons[surface.index];
            std::vector<Point> corners;
            for (std::uint32_t i = 0; i < polygon.count; ++i)
                corners.push_back(map.point(part.points[polygon.first + i]));
            layer.area_m2 += length(polygon_area_vector(corners.data(), corners.size()));
        } else {
            const double scale = similarity_scale(map);
            layer.area_m2 += scale * scale * surface_area_m2(part, surface);
        }
    });
    return layers;
}

Box exact_bounds(const Imported& imported)
{
    Box box;
    visit_expanded(imported.scene, [&](const Part& part, const Surface& surface, const Affine& map, ModifierId) {
        box.extend(surface_bounds(part, surface, map));
    });
    return box;
}

} // namespace lightwell::test
