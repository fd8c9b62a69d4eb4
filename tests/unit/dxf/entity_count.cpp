#include "tests/unit/dxf/entity_count.h"

#include "importers/dxf/block_plan.h"
#include "importers/dxf/external_files.h"

#include <set>

namespace lightwell::test {

std::size_t entities_to_account_for(const std::filesystem::path& file)
{
    Report report;
    const dxf::Drawing drawing = dxf::read_drawing_with_references(file, report);
    std::set<std::size_t> seen;
    const auto add = [&](const dxf::EntityRange& range) {
        for (std::size_t i = range.first; i < range.first + range.count; ++i)
            seen.insert(i);
    };
    for (const dxf::EntityRange& range : drawing.model)
        add(range);
    for (const dxf::EntityRange& range : drawing.paper)
        add(range);
    for (const dxf::BlockUse& use : dxf::plan_blocks(drawing))
        add(drawing.blocks[use.block].entities);
    std::size_t texts = 0;
    for (const dxf::Attribute& attribute : drawing.attributes)
        texts += seen.count(attribute.insert);
    return seen.size() + texts;
}

} // namespace lightwell::test
