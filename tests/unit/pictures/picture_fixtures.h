#pragma once

#include "engine/base/errors.h"
#include "engine/base/random.h"
#include "engine/pictures/picture.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <unistd.h>

namespace lightwell::test {

/// A folder of its own for each test, gone afterwards.
class Folder {
public:
    Folder()
    {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        // Thousands of small files are written; in memory where the system offers that.
        const std::filesystem::path memory = "/dev/shm";
        path_ = (access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path()) /
                ("lightwell-" + std::to_string(getpid()) + "-" + info->test_suite_name() + "-" + info->name());
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~Folder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    std::size_t file_count() const
    {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
    }

private:
    std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
inline void write_bytes(const std::filesystem::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary) << bytes;
}

/// Values over the whole range of float, both signs.
inline Picture noise(int width, int height, const std::vector<std::string>& channels, std::uint64_t seed = 1)
{
    Picture picture{width, height, {}, {}};
    RandomStream random(seed);
    for (const std::string& name : channels)
        for (float& value : picture.add_channel(name))
            value = static_cast<float>((random.next() - 0.5) * std::pow(10.0, 60 * random.next() - 30));
    return picture;
}

/// The part of a picture that is the tile at (x, y).
inline Picture tile_of(const Picture& whole, int x, int y, int size)
{
    Picture tile{std::min(size, whole.width - x), std::min(size, whole.height - y), {}, {}};
    for (const auto& [name, values] : whole.channels) {
        std::vector<float>& part = tile.add_channel(name);
        for (int row = 0; row < tile.height; ++row)
            for (int column = 0; column < tile.width; ++column)
                part[static_cast<std::size_t>(row * tile.width + column)] = whole.at(name, x + column, y + row);
    }
    return tile;
}

inline std::filesystem::path shared_folder()
{
    const char* named = std::getenv("LIGHTWELL_SHARED");
    return named != nullptr ? std::filesystem::path(named) : std::filesystem::path(LIGHTWELL_ROOT) / ".." / "shared";
}

/// The text of the InputError that `call` throws; a test failure when it throws none.
template <class Call>
std::string error_of(const Call& call)
{
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "no InputError was thrown";
    return {};
}

} // namespace lightwell::test
