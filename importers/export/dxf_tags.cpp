#include "importers/export/dxf_tags.h"

#include "engine/base/text.h"

#include <fmt/format.h>

namespace lightwell {

void DxfTags::tag(int code, const std::string& value)
{
    fmt::format_to(std::back_inserter(text_), "{:>3}\n{}\n", code, value);
}

void DxfTags::number(int code, double value)
{
    std::string text = shortest(value);
    if (text.find_first_of(".e") == std::string::npos)
        text += ".0"; // programs tell real numbers from integers by the point
    tag(code, text);
}

void DxfTags::point(int code, const Point& point)
{
    number(code, point.x);
    number(code + 10, point.y);
    number(code + 20, point.z);
}

void DxfTags::name(int code, const std::string& text)
{
    std::string escaped;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20)
            escaped += fmt::format("\\U+{:04X}", byte);
        else
            escaped += c;
    }
    tag(code, escaped.empty() ? std::string("0") : escaped);
}

std::string DxfTags::next_handle() const
{
    return fmt::format("{:X}", handles_);
}

std::string DxfTags::take_handle()
{
    const std::string handle = next_handle();
    ++handles_;
    return handle;
}

std::string DxfTags::begin(const std::string& type, const std::string& owner)
{
    const std::string handle = take_handle();
    tag(0, type);
    tag(5, handle);
    tag(330, owner);
    return handle;
}

} // namespace lightwell
