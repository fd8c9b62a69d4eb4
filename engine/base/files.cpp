#include "engine/base/files.h"

#include "engine/base/errors.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lightwell {

MappedFile::MappedFile(const std::filesystem::path& file)
{
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        throw InputError{file.string(), std::string("cannot be read: ") + std::strerror(errno),
                         "check name and rights"};
    struct stat status {};
    const bool regular = fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
    if (regular && status.st_size > 0) {
        size_ = static_cast<std::size_t>(status.st_size);
        void* mapped = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
        data_ = mapped == MAP_FAILED ? nullptr : static_cast<const char*>(mapped);
    }
    close(descriptor);
    if (!regular)
        throw InputError{file.string(), "is not a regular file", "give the name of a file"};
    if (size_ > 0 && data_ == nullptr)
        throw InputError{file.string(), std::string("cannot be mapped: ") + std::strerror(errno), {}};
}

MappedFile::~MappedFile()
{
    if (data_ != nullptr)
        munmap(const_cast<char*>(data_), size_);
}

void write_atomically(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write)
{
    std::filesystem::path temporary = file;
    temporary += ".writing-" + std::to_string(getpid());
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!std::filesystem::is_directory(folder))
        throw InputError{file.string(), "the folder " + folder.string() + " does not exist", "make it first"};
    try {
        write(temporary);
        std::filesystem::rename(temporary, file);
    } catch (const std::exception& error) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw InputError{file.string(), std::string("cannot be written: ") + error.what(),
                         "check rights and free space"};
    }
}

void write_text_atomically(const std::filesystem::path& file, std::string_view text)
{
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
        out.close();
        if (!out)
            throw std::runtime_error(std::strerror(errno));
    });
}

} // namespace lightwell
