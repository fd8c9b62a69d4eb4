#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/import_checks.h"
#include "tests/unit/dxf/entity_count.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    survive([&] {
        const std::filesystem::path file = fuzz_folder().write("fuzz.dxf", as_text(data, size));
        Imported imported = import_dxf(file, {});
        if (imported.ledger.read_count() != test::entities_to_account_for(file))
            std::abort();
        check_import(std::move(imported));
    });
    return 0;
}
