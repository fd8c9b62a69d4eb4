#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace lightwell {

/// A file mapped read-only into memory for as long as the object lives.
class MappedFile {
public:
    /// @throws InputError when the file is missing, a folder, or unreadable
    explicit MappedFile(const std::filesystem::path& file);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    std::string_view bytes() const noexcept { return {data_, size_}; }

private:
    const char* data_ = nullptr;
    std::size_t size_ = 0;
};

/// Calls `write` with a temporary name beside `file`, then renames: the final name never holds half a file.
/// When `write` throws, the temporary file is removed and the final name is as it was.
/// @throws InputError when the folder does not exist or cannot be written
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write);
/// The same for text that is already in memory.
void write_text_atomically(const std::filesystem::path& file, std::string_view text);

} // namespace lightwell
