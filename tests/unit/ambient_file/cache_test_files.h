#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

namespace lightwell {

/// A file name of this process alone; what stands there is removed before and after.
class ScratchFile {
public:
    explicit ScratchFile(const std::string& name)
        : path(std::filesystem::temp_directory_path() /
               ("lightwell_cache_" + std::to_string(getpid()) + "_" + name + ".amb"))
    {
        std::filesystem::remove_all(path);
    }
    ~ScratchFile() { std::filesystem::remove_all(path); }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    std::string bytes() const
    {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void put(const std::string& bytes) const { std::ofstream(path, std::ios::binary) << bytes; }

    const std::filesystem::path path;
};

} // namespace lightwell
