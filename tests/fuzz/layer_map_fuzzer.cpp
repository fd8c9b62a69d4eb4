#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/import_checks.h"

namespace {

/// Layers, blocks, materials and colours for rules to match, in a model that every run copies.
const lightwell::Imported& model()
{
    static const lightwell::Imported imported = [] {
        const auto file = lightwell::fuzz_folder().write(
            "model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no Room\ng A-WALL\nusemtl plaster\nf 1 2 3\n"
                         "g A-GLAZ\nusemtl glass\nf 1 2 4\no Lamp\ng E-LITE\nf 2 3 4\ng A-FLOR oak\nf 1 3 4\n");
        return lightwell::import_obj(file, {});
    }();
    return imported;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    survive([&] {
        const LayerMap map = read_layer_map(fuzz_folder().write("map.toml", as_text(data, size)));
        Imported imported = model();
        apply_layer_map(imported, map);
        validate(imported.scene);
    });
    return 0;
}
