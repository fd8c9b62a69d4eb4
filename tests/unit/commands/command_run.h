#pragma once

#include "plugins/commands/command.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

/// \file Runs commands within the test program, on texts instead of files.
namespace lightwell::commands {

struct Ran {
    int status = 0;
    std::string out, err;
};

inline Ran run(const std::vector<std::string>& words, const std::string& input = {})
{
    std::istringstream in(input);
    std::ostringstream out, err;
    Ran ran;
    ran.status = run_command(words, {in, out, err});
    ran.out = out.str();
    ran.err = err.str();
    return ran;
}

inline std::vector<std::string> words_of(const std::string& line)
{
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;)
        words.push_back(word);
    return words;
}

inline Ran run(const std::string& line, const std::string& input = {})
{
    return run(words_of(line), input);
}

inline std::filesystem::path shared_data()
{
    const char* const folder = std::getenv("LIGHTWELL_SHARED");
    return folder != nullptr ? folder : LIGHTWELL_ROOT "/../shared";
}

/// A folder that is the working folder while it lives.
class WorkFolder {
public:
    WorkFolder() : before_(std::filesystem::current_path())
    {
        std::string name = (std::filesystem::temp_directory_path() / "lightwell-XXXXXX").string();
        folder_ = mkdtemp(name.data());
        std::filesystem::current_path(folder_);
    }
    ~WorkFolder()
    {
        std::filesystem::current_path(before_);
        std::filesystem::remove_all(folder_);
    }
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
    static std::string read(const std::string& name)
    {
        std::ifstream file(name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

private:
    std::filesystem::path before_, folder_;
};

/// How two texts differ, number by number; empty when they agree.
/// @param tolerance  relative; beside it half a unit of the last digit that the expected number shows
inline std::string difference(const std::string& found, const std::string& expected, double tolerance, double absolute)
{
    const std::vector<std::string> a = words_of(found), b = words_of(expected);
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
        if (i >= a.size() || i >= b.size())
            return "one text has more words: " + (i < a.size() ? "found " + a[i] : "expected " + b[i]);
        char *end_a = nullptr, *end_b = nullptr;
        const double x = std::strtod(a[i].c_str(), &end_a), y = std::strtod(b[i].c_str(), &end_b);
        const bool numbers = *end_a == 0 && *end_b == 0;
        if (numbers ? !(std::fabs(x - y) <= absolute + tolerance * std::fabs(y)) : a[i] != b[i])
            return "word " + std::to_string(i) + ": found " + a[i] + ", expected " + b[i];
    }
    return {};
}

} // namespace lightwell::commands
