#include "engine/pictures/image_file.h"
#include "engine/pictures/rgbe.h"
#include "tests/fuzz/fuzz_file.h"

/// The bytes are a Radiance picture (RGBE or XYZE), and a PNG or JPEG.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    survive([&] { read_rgbe(fuzz_folder().write("fuzz.hdr", as_text(data, size))); });
    survive([&] { read_image(as_text(data, size), "fuzz.png"); });
    return 0;
}
