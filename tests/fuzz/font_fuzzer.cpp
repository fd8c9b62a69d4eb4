#include "materials/patterns/font.h"
#include "tests/fuzz/fuzz_file.h"

/// The bytes are a font; every character of it is asked whether it covers its middle.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    survive([&] {
        const PolygonFont font = PolygonFont::parse(as_text(data, size), "fuzz.fnt");
        for (int code = 0; code < 256; ++code)
            if (const PolygonFont::Glyph* glyph = font.glyph(static_cast<unsigned char>(code)))
                PolygonFont::covers(*glyph, {0.5, 0.5});
        font.mean_width();
    });
    return 0;
}
