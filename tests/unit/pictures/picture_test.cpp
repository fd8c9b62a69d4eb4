#include "engine/pictures/exr.h"
#include "tests/unit/pictures/picture_fixtures.h"

#include <limits>

namespace lightwell {

using namespace test;

TEST(PartOfAPicture, IsKeptByAFileAsItsDataWindow)
{
    const Folder folder;
    const Picture whole = noise(200, 100, {"R", "G", "B"});
    Picture part = noise(70, 97, {"R", "G", "B"}); // larger than one tile
    part.place = {130, 3, 200, 100};
    write_exr(part, folder / "part.exr");
    const Picture read = read_exr(folder / "part.exr");
    EXPECT_EQ(read.place, part.place);
    EXPECT_EQ(read.channels, part.channels);
    write_exr(whole, folder / "whole.exr");
    EXPECT_EQ(read_exr(folder / "whole.exr").place, Picture::Place{});
}

TEST(PartOfAPicture, AnAbsurdPlaceIsRefused)
{
    const Folder folder;
    Picture picture = noise(4, 4, {"R"});
    constexpr int most = std::numeric_limits<int>::max();
    for (const Picture::Place& place : {Picture::Place{most, 0, 9, 9}, Picture::Place{0, -most, 9, 9},
                                        Picture::Place{0, 0, most, 9}, Picture::Place{0, 0, 9, -1}}) {
        picture.place = place;
        EXPECT_NE(error_of([&] { write_exr(picture, folder / "p.exr"); }).find("a whole of"), std::string::npos);
        EXPECT_EQ(folder.file_count(), 0u);
    }
}

} // namespace lightwell
