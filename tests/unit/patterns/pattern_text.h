#pragma once

#include "importers/radiance/transform_words.h"
#include "materials/patterns/pattern_reader.h"

#include <filesystem>
#include <fstream>

namespace lightwell {

/// A folder for one test, with files; removed at the end.
class PatternFolder {
public:
    PatternFolder()
        : folder_(std::filesystem::temp_directory_path() / ("lightwell-patterns-" + std::to_string(getpid())))
    {
        std::filesystem::create_directories(folder_);
    }
    ~PatternFolder() { std::filesystem::remove_all(folder_); }
    PatternFolder(const PatternFolder&) = delete;
    PatternFolder& operator=(const PatternFolder&) = delete;

    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
    std::filesystem::path path(const std::string& name) const { return folder_ / name; }

    std::shared_ptr<const PlaceFunction> pattern(const std::string& type, const std::vector<std::string>& words,
                                                 const std::vector<double>& numbers = {}) const
    {
        PatternReader::Request request;
        request.type = type;
        request.words = words;
        request.numbers = numbers;
        request.place = "scene.rad:3: " + type + " \"p\"";
        request.find_file = [&](const std::string& name) {
            return std::filesystem::exists(folder_ / name) ? std::optional(folder_ / name) : std::nullopt;
        };
        request.read_transform = [](const std::vector<std::string>& all, std::size_t begin) {
            return scene_text::read_placements(all, begin, "test").front().map;
        };
        return PatternReader().read(request);
    }

private:
    std::filesystem::path folder_;
};

} // namespace lightwell
