#include "importers/export/dxf_entities.h"
#include "importers/export/export.h"

#include "engine/base/files.h"
#include "engine/base/text.h"

#include <set>

namespace lightwell {
namespace {

constexpr const char* model_space = "1F";
constexpr const char* paper_space = "1B";

/// The tables that programs expect beside the layers, with fixed handles.
void write_tables(DxfTags& tags, const std::vector<std::string>& layers, const std::vector<DxfBlock>& blocks)
{
    const auto table = [&](const char* name, const char* handle, std::size_t entries) {
        tags.tag(0, "TABLE");
        tags.tag(2, name);
        tags.tag(5, handle);
        tags.tag(330, "0");
        tags.tag(100, "AcDbSymbolTable");
        tags.tag(70, static_cast<std::int64_t>(entries));
    };
    const auto entry = [&](const char* type, const char* table_handle, const char* subclass, const std::string& name) {
        tags.begin(type, table_handle);
        tags.tag(100, "AcDbSymbolTableRecord");
        tags.tag(100, subclass);
        tags.name(2, name);
    };
    const auto end = [&] { tags.tag(0, "ENDTAB"); };
    tags.tag(0, "SECTION");
    tags.tag(2, "TABLES");
    table("LTYPE", "5", 3);
    for (const char* name : {"ByBlock", "ByLayer", "Continuous"}) {
        entry("LTYPE", "5", "AcDbLinetypeTableRecord", name);
        tags.tag(70, 0);
        tags.tag(3, "");
        tags.tag(72, 65);
        tags.tag(73, 0);
        tags.number(40, 0);
    }
    end();
    table("LAYER", "2", layers.size());
    for (const std::string& layer : layers) {
        entry("LAYER", "2", "AcDbLayerTableRecord", layer);
        tags.tag(70, 0);
        tags.tag(62, 7);
        tags.tag(6, "Continuous");
    }
    end();
    table("APPID", "9", 1);
    entry("APPID", "9", "AcDbRegAppTableRecord", "ACAD");
    tags.tag(70, 0);
    end();
    table("BLOCK_RECORD", "1", blocks.size());
    for (const DxfBlock& block : blocks) {
        tags.tag(0, "BLOCK_RECORD");
        tags.tag(5, block.record);
        tags.tag(330, "1");
        tags.tag(100, "AcDbSymbolTableRecord");
        tags.tag(100, "AcDbBlockTableRecord");
        tags.name(2, block.name);
    }
    end();
    tags.tag(0, "ENDSEC");
}

void write_header(DxfTags& tags, const std::string& next_handle)
{
    tags.tag(0, "SECTION");
    tags.tag(2, "HEADER");
    const auto variable = [&](const char* name, int code, const std::string& value) {
        tags.tag(9, name);
        tags.tag(code, value);
    };
    variable("$ACADVER", 1, "AC1027");
    variable("$DWGCODEPAGE", 3, "ANSI_1252");
    variable("$INSUNITS", 70, "6"); // metres
    variable("$MEASUREMENT", 70, "1");
    variable("$HANDSEED", 5, next_handle);
    tags.tag(0, "ENDSEC");
}

void write_objects(DxfTags& tags)
{
    tags.tag(0, "SECTION");
    tags.tag(2, "OBJECTS");
    tags.tag(0, "DICTIONARY");
    tags.tag(5, "C");
    tags.tag(330, "0");
    tags.tag(100, "AcDbDictionary");
    tags.tag(281, 1);
    tags.tag(0, "ENDSEC");
    tags.tag(0, "EOF");
}

/// Names that differ, in any case of letters.
std::vector<DxfBlock> name_blocks(const Scene& scene)
{
    std::vector<DxfBlock> blocks{{"*Model_Space", model_space}, {"*Paper_Space", paper_space}};
    std::set<std::string> taken;
    for (std::size_t i = 0; i < scene.prototypes.size(); ++i) {
        const std::string wanted = scene.prototypes[i].name.empty() ? "block" : scene.prototypes[i].name;
        std::string name = wanted.starts_with('*') ? "_" + wanted : wanted;
        for (int number = 2; !taken.insert(lowercase_ascii(name)).second; ++number)
            name = wanted + '~' + std::to_string(number);
        blocks.push_back({name, {}});
    }
    return blocks;
}

std::vector<std::string> layers_of(const Imported& model)
{
    std::set<std::string> layers{"0"};
    for (const SurfaceKey& key : model.keys)
        layers.insert(key.layer);
    return {layers.begin(), layers.end()};
}

} // namespace

void export_dxf(const Imported& model, const std::filesystem::path& file, const ExportOptions& options, Report& report)
{
    std::vector<DxfBlock> blocks = name_blocks(model.scene);
    DxfTags entities;
    for (std::size_t i = 2; i < blocks.size(); ++i)
        blocks[i].record = entities.take_handle();
    DxfEntities writer{model, blocks, options, report, entities};
    entities.tag(0, "SECTION");
    entities.tag(2, "BLOCKS");
    for (std::size_t i = 0; i < blocks.size(); ++i)
        writer.write_block(i < 2 ? nullptr : &model.scene.prototypes[i - 2], blocks[i]);
    entities.tag(0, "ENDSEC");
    entities.tag(0, "SECTION");
    entities.tag(2, "ENTITIES");
    writer.write_part(model.scene.root, model_space);
    entities.tag(0, "ENDSEC");
    DxfTags tables{entities};
    tables.clear_text();
    write_tables(tables, layers_of(model), blocks);
    DxfTags header;
    write_header(header, tables.next_handle());
    DxfTags objects;
    write_objects(objects);
    write_text_atomically(file, header.text() + tables.text() + entities.text() + objects.text());
}

} // namespace lightwell
