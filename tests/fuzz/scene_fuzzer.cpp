#include "importers/radiance/radiance.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    survive([&] {
        Report report;
        validate(read_radiance(fuzz_folder().write("fuzz.rad", as_text(data, size)), report));
    });
    return 0;
}
