#include "materials/functions/definitions.h"

#include "materials/functions/function_text.h"

namespace lightwell {
namespace {

constexpr char mark = '`';

/// The name under which a definition is kept.
std::string full_name(const std::string& name, const std::string& context)
{
    if (name.size() > 1 && name.back() == mark)
        return name.substr(0, name.size() - 1);
    if (name.size() > 1 && name.front() == mark)
        return name.substr(1) + context;
    return name + context;
}

} // namespace

void Definitions::add(std::string_view text, const std::string& file, const std::string& context)
{
    for (Definition& definition : parse_definitions(text, file, context.empty() ? "" : mark + context)) {
        std::string key = full_name(definition.name, definition.context);
        by_name_[std::move(key)] = std::make_shared<const Definition>(std::move(definition));
    }
}

const Definition* Definitions::find(const std::string& name, const std::string& context) const
{
    const auto look = [&](const std::string& key) {
        const auto found = by_name_.find(key);
        return found == by_name_.end() ? nullptr : found->second.get();
    };
    const bool one_place = name.size() > 1 && (name.back() == mark || name.front() == mark);
    if (const Definition* own = look(full_name(name, context)); own != nullptr || one_place)
        return own;
    // Of a context within a context the outer one is asked next.
    for (std::size_t at = context.find(mark, 1); at != std::string::npos; at = context.find(mark, at + 1))
        if (const Definition* outer = look(name + context.substr(at)))
            return outer;
    return look(name);
}

const std::string_view* standard_function_file(std::string_view name)
{
    for (const FunctionText& text : function_texts())
        if (name == text.file)
            return &text.text;
    return nullptr;
}

Definitions standard_definitions(bool of_material)
{
    Definitions definitions;
    definitions.add(*standard_function_file("rayinit.cal"), "rayinit.cal");
    if (of_material)
        definitions.add(*standard_function_file("rayinit_material.cal"), "rayinit_material.cal");
    return definitions;
}

} // namespace lightwell
