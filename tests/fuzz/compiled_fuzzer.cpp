#include "importers/radiance/compiled_bytes.h"
#include "importers/radiance/compiled_scene.h"
#include "tests/fuzz/fuzz_file.h"

#include <algorithm>
#include <cstring>
#include <sstream>

namespace {

using namespace lightwell;

/// A small compiled scene, into which the bytes are laid.
std::string seed()
{
    Report report;
    const NamedScene named = read_radiance_sources(
        {{"seed.rad",
          "void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n"
          "grey sphere s 0 0 4 0 0 1 .2\nvoid light lamp 0 0 3 9 9 9\nlamp ring r 0 0 8 0 0 2 0 0 -1 0 .1\n"}},
        report);
    std::ostringstream out;
    write_compiled(named, {}, out);
    return out.str();
}

/// Makes the checksum at the end fit what stands before it.
void seal(std::string& bytes)
{
    using namespace scene_text;
    const std::size_t body = bytes.find(compiled_mark) + compiled_mark.size();
    const std::size_t tail = bytes.size() - compiled_end.size() - 2 * sizeof(std::uint64_t);
    if (body > tail)
        return;
    ByteSum sum;
    sum.add(bytes.data() + body, tail - body);
    const std::uint64_t value = sum.sum();
    std::memcpy(bytes.data() + tail, &value, sizeof value);
}

} // namespace

/// The first two bytes say where in a whole file the others stand in place of its own; the checksum is made to fit, so
/// that what lies behind it is reached. Bytes that are a compiled scene themselves are read as they are.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const std::string whole = seed();
    std::string bytes(as_text(data, size));
    if (!is_compiled_scene(bytes)) {
        if (size < 2)
            return 0;
        const std::size_t at = (data[0] + 256u * data[1]) % whole.size();
        const std::size_t count = std::min(size - 2, whole.size() - at);
        bytes = whole;
        bytes.replace(at, count, as_text(data + 2, count));
        if (!is_compiled_scene(bytes))
            return 0;
        seal(bytes);
    }
    survive([&] {
        Report report;
        validate(read_radiance_sources({{"fuzz.oct", bytes}}, report).scene);
    });
    return 0;
}
