#include "tests/unit/radiance/ply_writer.h"
#include "tests/unit/radiance/scene_folder.h"

#include <gtest/gtest.h>

#include <limits>

namespace lightwell {
namespace {

const std::string red = "void plastic red\n0\n0\n5 .7 .1 .1 0 0\n";

const PlyFaces triangle{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {{0, 1, 2}}};

PlyFaces with(void (*change)(PlyFaces&))
{
    PlyFaces faces = triangle;
    change(faces);
    return faces;
}

TEST(PlyDamage, EachMistakeHasOneSentenceWithFileAndPlace)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    PlyFaces not_finite = triangle;
    not_finite.points[4] = nan;
    const std::string ascii = "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n";
    const std::string huge = PlyWriter("element vertex 999999999999999\nproperty double x\n").data().bytes();
    const std::string nothing_each = PlyWriter("element vertex 999999999999999\n").data().bytes();
    const auto modifier = [](int value) {
        PlyFaces faces = triangle;
        faces.face_properties = "property int modifier\n";
        return faces.bytes([&](PlyWriter& ply, std::size_t) { ply.put(value); });
    };
    PlyFaces uv = triangle;
    uv.face_properties = "property list uchar float s_t\n";
    const std::string short_list = uv.bytes([](PlyWriter& ply, std::size_t) {
        ply.put(static_cast<unsigned char>(4)).all(std::vector<float>{0, 0, 1, 1});
    });
    const struct {
        std::string bytes, beginning;
    } damages[] = {
        {"", "a.ply: does not begin with `ply`"},
        {"solid stl", "a.ply: does not begin with `ply`"},
        {"ply\nformat binary_little_endian 1.0\n", "a.ply:3: the header ends without `end_header`"},
        {ascii, "a.ply:2: format is \"ascii\", expected binary_little_endian 1.0"},
        {"ply\nend_header\n", "a.ply: the header has no `format`"},
        {PlyWriter("element vertex -3\n").data().bytes(), "a.ply:3: expected `element NAME COUNT`"},
        {PlyWriter("property int x\n").data().bytes(), "a.ply:3: a property without an element"},
        {PlyWriter("element vertex 1\nproperty quad x\n").data().bytes(), "a.ply:4: type \"quad\" is not known"},
        {PlyWriter("vertex 1\n").data().bytes(), "a.ply:3: \"vertex\" is no word of a PLY header"},
        {PlyWriter("comment modifier x red\n").data().bytes(), "a.ply: there is no element \"vertex\""},
        {huge, "a.ply: the header says 999999999999999 of element vertex, the file has room for 0"},
        {nothing_each, "a.ply: the header says 999999999999999 of element vertex, the file has room for 0"},
        {triangle.bytes() + "x", "a.ply: 1 bytes are left over"},
        {not_finite.bytes(), "a.ply: vertex 1: y is not finite"},
        {with([](PlyFaces& f) {
             f.faces = {{0, 1, 3}};
         }).bytes(),
         "a.ply: face 0 names vertex 3 of 3"},
        {with([](PlyFaces& f) {
             f.faces = {{0, 1, -1}};
         }).bytes(),
         "a.ply: face 0 names vertex -1 of 3"},
        {with([](PlyFaces& f) {
             f.faces = {{0, 1}};
         }).bytes(),
         "a.ply: face 0 has 2 corners, expected at least 3"},
        {modifier(2), "a.ply: face 0 has modifier 2, for which the header has no name"},
        {modifier(-2), "a.ply: face 0 has modifier -2, for which the header has no name"},
        {short_list, "a.ply: face 0: 4 numbers in \"s_t\", expected 2 for each of 3 corners"},
        {with([](PlyFaces& f) { f.comments = "comment boundary round\n"; }).bytes(), "a.ply: `comment boundary round`"},
        {with([](PlyFaces& f) { f.comments = "comment modifier 99999999 x\n"; }).bytes(),
         "a.ply: `comment modifier 99999999 x`: expected a number from 0 to 65535"},
    };
    const SceneFolder folder;
    for (const auto& [bytes, beginning] : damages) {
        folder.write("a.ply", bytes);
        const std::string message = folder.error(red + "red mesh m 1 a.ply 0 0");
        EXPECT_TRUE(message.starts_with(beginning)) << "gave: " << message << "\nexpected: " << beginning;
    }
}

TEST(PlyDamage, TheLineInTheSceneIsNamedWhereItIsWrong)
{
    const SceneFolder folder;
    folder.write("a.ply", triangle.bytes());
    PlyFaces named = triangle;
    named.comments = "comment modifier 0 gone\n";
    named.face_properties = "property int modifier\n";
    folder.write("named.ply", named.bytes([](PlyWriter& ply, std::size_t) { ply.put(0); }));
    const struct {
        const char *line, *beginning;
    } damages[] = {
        {"red mesh m 1 gone.ply 0 0", "scene.rad:5: mesh \"m\": file \"gone.ply\" is not found"},
        {"void mesh m 1 a.ply 0 0", "scene.rad:5: mesh \"m\": it is made of `void`"},
        {"red mesh m 1 named.ply 0 0", "scene.rad:5: mesh \"m\": modifier \"gone\" is not defined above"},
        {"red mesh m 13 a.ply -affine 1 0 0 0 0 1 0 0 0 0 1 0 0", "scene.rad:5: mesh \"m\": -affine is followed by"},
        {"red mesh m 14 a.ply -affine 1 0 0 0 0 1 0 0 0 0 0 0 0 0",
         "scene.rad:5: mesh \"m\": the transform is singular"},
        {"red mesh m 14 a.ply -affine 1 0 0 0 0 1 0 x 0 0 1 0 0 0", "scene.rad:5: mesh \"m\": -affine is followed by"},
        {"red subdivision m 1 a.ply 0 0", "scene.rad:5: subdivision \"m\": expected one number > 0"},
        {"red subdivision m 1 a.ply 0 1 -1", "scene.rad:5: subdivision \"m\": expected one number > 0"},
        {"red subdivision m 1 a.obj 0 1 .1", "scene.rad:5: subdivision \"m\": \"a.obj\" is no control cage"},
        {"red subdivision m 0 0 1 .1", "scene.rad:5: subdivision \"m\": no file name"},
    };
    for (const auto& [line, beginning] : damages) {
        const std::string message = folder.error(red + line);
        EXPECT_TRUE(message.starts_with(beginning)) << line << "\ngave: " << message;
    }
}

TEST(PlyDamage, NoCutOfAFileIsTakenForTheWhole)
{
    const SceneFolder folder;
    const std::string whole = triangle.bytes();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        folder.write("a.ply", whole.substr(0, size));
        EXPECT_NE(folder.error(red + "red mesh m 1 a.ply 0 0"), "") << size;
    }
    folder.write("a.ply", whole);
    EXPECT_EQ(folder.error(red + "red mesh m 1 a.ply 0 0"), "");
}

TEST(PlyDamage, NoSingleChangedByteCrashes)
{
    const SceneFolder folder;
    const std::string whole = triangle.bytes();
    int refused = 0;
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const char c : {'\0', '9', '\xFF'}) {
            std::string damaged = whole;
            damaged[i] = c;
            folder.write("a.ply", damaged);
            refused += folder.error(red + "red mesh m 1 a.ply 0 0").empty() ? 0 : 1;
            refused += folder.error(red + "red subdivision m 1 a.ply 0 1 .1").empty() ? 0 : 1;
        }
    EXPECT_GT(refused, 250);
}

} // namespace
} // namespace lightwell
