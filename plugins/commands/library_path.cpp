#include "plugins/commands/library_path.h"

#include <cstdlib>
#include <istream>
#include <string_view>

namespace lightwell::commands {

std::optional<std::filesystem::path> find_in_library(const std::string& name)
{
    std::error_code unreadable;
    if (std::filesystem::is_regular_file(name, unreadable))
        return name;
    const char* const path = std::getenv("RAYPATH");
    std::string_view rest = path == nullptr ? "" : path;
    while (!rest.empty() && !std::filesystem::path(name).is_absolute()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        const std::filesystem::path candidate = std::filesystem::path(rest.substr(0, end)) / name;
        if (std::filesystem::is_regular_file(candidate, unreadable))
            return candidate;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return std::nullopt;
}

std::string whole_stream(std::istream& in)
{
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace lightwell::commands
