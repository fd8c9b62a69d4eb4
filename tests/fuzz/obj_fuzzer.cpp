#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/import_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    survive([&] { check_import(import_obj(fuzz_folder().write("fuzz.obj", as_text(data, size)), {})); });
    return 0;
}
