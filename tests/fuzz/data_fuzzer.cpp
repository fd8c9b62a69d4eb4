#include "materials/patterns/data_table.h"
#include "tests/fuzz/fuzz_file.h"

/// The bytes are a data file; what is accepted is asked within, at and beyond its ends.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace lightwell;
    survive([&] {
        const DataTable table = DataTable::parse(as_text(data, size), "fuzz.dat");
        for (const double at : {0.0, 0.5, -1e300, 1e300}) {
            double coordinates[DataTable::most_dimensions];
            for (double& coordinate : coordinates)
                coordinate = at;
            table.at(coordinates);
        }
    });
    return 0;
}
