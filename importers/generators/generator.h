#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

/// What a command wrote, and how it ended.
struct GeneratorAnswer {
    std::string text;     ///< scene text
    std::string messages; ///< for standard error, each line complete
    int status = 0;       ///< 0: done
};
/// What a command may read beside its words.
struct GeneratorInput {
    /// Where a file named by a word is; nothing when it is not found.
    std::function<std::optional<std::filesystem::path>(const std::string&)> find_file;
    std::function<std::string()> standard_input = {}; ///< for the word `-`; may be empty
};
/// A command that makes scene text: `genbox genprism genrev gensurf genworm genblinds gensky gendaylit`.
/// @param words  the command's name first
using Generator = GeneratorAnswer (*)(const std::vector<std::string>& words, const GeneratorInput& input);
/// Null when no such command is known here.
Generator find_generator(std::string_view name);
std::vector<std::string> generator_names();

GeneratorAnswer genbox(const std::vector<std::string>& words, const GeneratorInput& input);
GeneratorAnswer genprism(const std::vector<std::string>& words, const GeneratorInput& input);
GeneratorAnswer genrev(const std::vector<std::string>& words, const GeneratorInput& input);
GeneratorAnswer genworm(const std::vector<std::string>& words, const GeneratorInput& input);
GeneratorAnswer gensurf(const std::vector<std::string>& words, const GeneratorInput& input);
GeneratorAnswer genblinds(const std::vector<std::string>& words, const GeneratorInput& input);
GeneratorAnswer gensky(const std::vector<std::string>& words, const GeneratorInput& input);
GeneratorAnswer gendaylit(const std::vector<std::string>& words, const GeneratorInput& input);

} // namespace lightwell
