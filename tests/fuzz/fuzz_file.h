#pragma once

#include "engine/base/errors.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace lightwell {

/// A folder of this process in memory, removed at its end: readers take files, and a disc would be the slowest part.
class FuzzFolder {
public:
    FuzzFolder() : path_("/dev/shm/lightwell-fuzz-" + std::to_string(getpid()))
    {
        std::filesystem::create_directories(path_);
    }
    ~FuzzFolder() { std::filesystem::remove_all(path_); }
    FuzzFolder(const FuzzFolder&) = delete;
    FuzzFolder& operator=(const FuzzFolder&) = delete;

    std::filesystem::path write(const std::string& name, std::string_view bytes) const
    {
        const std::filesystem::path file = path_ / name;
        const int handle = open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        const bool whole =
            handle >= 0 && ::write(handle, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
        close(handle);
        if (!whole)
            std::abort(); // no room in memory: a run that reads nothing must not look like one that found nothing
        return file;
    }

private:
    std::filesystem::path path_;
};

inline const FuzzFolder& fuzz_folder()
{
    static const FuzzFolder folder;
    return folder;
}

/// Calls read() and lets pass what readers promise to throw; anything else ends the run.
template <class Read>
void survive(const Read& read)
{
    try {
        read();
    } catch (const InputError&) {
        // The one answer to bad input.
    }
}

inline std::string_view as_text(const std::uint8_t* data, std::size_t size)
{
    return {reinterpret_cast<const char*>(data), size};
}

} // namespace lightwell
