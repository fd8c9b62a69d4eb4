#include "importers/dxf/account.h"

#include <fmt/format.h>

namespace lightwell::dxf {
namespace {

void account_attributes(const Drawing& drawing, const std::vector<Reason>& outcomes, Imported& imported)
{
    for (const Attribute& attribute : drawing.attributes)
        if (outcomes[attribute.insert])
            imported.ledger.skipped("ATTRIB", drawing.layers[attribute.layer].name,
                                    "text, kept in the name of its insert");
}

/// Notes that such layers are kept: what the drawing shows on the screen is more likely meant than not.
void note_layers_not_plotted(const Drawing& drawing, const std::vector<std::size_t>& made_on, Report& report)
{
    for (std::size_t i = 0; i < drawing.layers.size(); ++i)
        if (!drawing.layers[i].is_plotted && made_on[i] > 0)
            report.add(Finding::assumed, drawing.file(),
                       fmt::format("layer \"{}\" is not plotted, but shown on the screen: it is kept; map it to void "
                                   "to leave it out",
                                   drawing.layers[i].name),
                       made_on[i]);
}

} // namespace

void account(const Drawing& drawing, const std::vector<Reason>& outcomes, const Repairs& repairs, Imported& imported)
{
    for (const auto& [index, what] : repairs) {
        const Entity& entity = drawing.entities[index];
        imported.ledger.repaired(drawing.types[entity.type], drawing.layers[entity.layer].name, what);
    }
    std::vector<std::size_t> made_on(drawing.layers.size(), 0);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        const Reason outcome = outcomes[i];
        if (!outcome)
            continue;
        const Entity& entity = drawing.entities[i];
        const std::string &type = drawing.types[entity.type], &layer = drawing.layers[entity.layer].name;
        if (outcome == &made) {
            imported.ledger.made(type, layer);
            ++made_on[entity.layer];
            continue;
        }
        imported.ledger.skipped(type, layer, outcome->text);
        if (outcome->loses_surfaces)
            imported.report.add(Finding::unsupported, drawing.place(entity),
                                fmt::format("{} on layer \"{}\": {}", type, layer, outcome->text));
    }
    account_attributes(drawing, outcomes, imported);
    note_layers_not_plotted(drawing, made_on, imported.report);
}

} // namespace lightwell::dxf
