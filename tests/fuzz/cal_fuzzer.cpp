#include "materials/functions/program.h"
#include "tests/fuzz/fuzz_file.h"

/// The bytes are a function file beside the standard names; the variable `v` is worked out at two places.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    survive([&] {
        static const Definitions standard = standard_definitions();
        Definitions definitions = standard;
        definitions.add(as_text(data, size), "fuzz.cal");
        Program program = Program::compile(definitions, {"v"}, "", {0.5, 2}, "fuzz.rad:1");
        constexpr WorkLimits soon{20'000, 3000}; // the bound is what is tried, not how far it lies
        program.set_limits(soon);
        for (const double at : {0.25, -1e30}) {
            const double channels[3]{at, 1, -at};
            double value = 0;
            program.evaluate(channels, {&value, 1});
        }
    });
    return 0;
}
