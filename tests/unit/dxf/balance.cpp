#include "tests/unit/dxf/balance.h"

#include "tests/unit/dxf/entity_count.h"

#include <gtest/gtest.h>

namespace lightwell::test {

void expect_balanced(const Imported& imported, const std::filesystem::path& file)
{
    std::size_t skipped = 0;
    for (const Ledger::Skipped& line : imported.ledger.skipped_list())
        skipped += line.count;
    EXPECT_EQ(imported.ledger.read_count(), imported.ledger.made_count() + skipped);
    EXPECT_EQ(imported.ledger.read_count(), entities_to_account_for(file));
}

} // namespace lightwell::test
