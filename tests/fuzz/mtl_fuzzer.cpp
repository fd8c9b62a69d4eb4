#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/import_checks.h"

/// The bytes are a library of materials; a model of one face for each of some names refers to it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    static const std::filesystem::path model = fuzz_folder().write(
        "fuzz.obj", "mtllib fuzz.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                    "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\nusemtl Material\nf 2 3 4\nusemtl glass\nf 1 3 4\n");
    survive([&] {
        fuzz_folder().write("fuzz.mtl", as_text(data, size));
        check_import(import_obj(model, {}));
    });
    return 0;
}
