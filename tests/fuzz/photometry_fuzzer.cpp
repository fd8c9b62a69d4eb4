#include "engine/scene/luminaire.h"
#include "tests/fuzz/fuzz_file.h"

#include <cmath>
#include <cstdlib>

/// The bytes are a photometric file; what is accepted becomes a luminaire in a scene, with and without a body.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    survive([&] {
        Report report;
        const Photometry photometry = read_photometry(fuzz_folder().write("fuzz.ies", as_text(data, size)), report);
        const double lumens = photometry.lumens();
        if (!(lumens >= 0) || !(photometry.candela_towards({0, 0, -1}) >= 0) || !(photometry.share_tilted(30) >= 0))
            std::abort();
        photometry.beam_angle_deg(45);
        for (const Vec3& body : {Vec3{}, Vec3{0.3, 0.6, 0.1}}) {
            Scene scene;
            scene.prototypes.push_back(luminaire_part(scene, photometry, {"lamp", true, 1, body}, report));
            scene.root.add_instance({0, {}, {}}, "lamp");
            validate(scene);
        }
    });
    return 0;
}
