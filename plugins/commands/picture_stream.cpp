#include "plugins/commands/picture_stream.h"

#include "engine/base/files.h"
#include "engine/pictures/rgbe.h"
#include "plugins/commands/command.h"
#include "plugins/commands/library_path.h"

#include <cstdlib>
#include <fstream>
#include <istream>
#include <ostream>
#include <unistd.h>

namespace lightwell::commands {
namespace {

/// A file of its own that goes when the object does.
class TemporaryFile {
public:
    TemporaryFile()
    {
        std::string name = (std::filesystem::temp_directory_path() / "lightwell-XXXXXX").string();
        const int descriptor = mkstemp(name.data());
        if (descriptor < 0)
            throw Fatal("no temporary file can be made in " + std::filesystem::temp_directory_path().string());
        close(descriptor);
        path = name;
    }
    ~TemporaryFile()
    {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::filesystem::path path;
};

} // namespace

void write_picture(const Picture& picture, std::ostream& out)
{
    const TemporaryFile file;
    write_rgbe(picture, file.path);
    out << MappedFile(file.path).bytes();
}

Picture read_picture(const std::string& name, std::istream& in, std::string& bytes)
{
    if (!name.empty() && name != "-") {
        const auto found = find_in_library(name);
        if (!found)
            throw Fatal("can't open file \"" + name + "\"");
        bytes = std::string(MappedFile(*found).bytes());
        return read_rgbe(*found);
    }
    bytes = whole_stream(in);
    const TemporaryFile file;
    std::ofstream(file.path, std::ios::binary) << bytes;
    return read_rgbe(file.path);
}

} // namespace lightwell::commands
