#include "materials/measured/measured_table.h"
#include "tests/fuzz/fuzz_file.h"

#include <cstdlib>

/// The bytes are a file of scattering; what is accepted answers with numbers from any side.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    survive([&] {
        const auto table = MeasuredTable::parse(as_text(data, size), "fuzz.xml");
        for (const Direction& in : {Direction{0, 0, 1}, Direction{0.6, 0, 0.8}, Direction{0, 0.6, -0.8}})
            for (const Direction& out : {Direction{0, 0, 1}, Direction{0, 0.6, 0.8}, Direction{-0.6, 0, -0.8}})
                if (!(table->value_per_sr(in, out) >= 0))
                    std::abort();
    });
    return 0;
}
