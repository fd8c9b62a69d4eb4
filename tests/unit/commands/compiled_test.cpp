#include "engine/base/errors.h"
#include "importers/radiance/compiled_bytes.h"
#include "importers/radiance/compiled_scene.h"
#include "tests/unit/commands/command_run.h"

#include <gtest/gtest.h>

/// \file oconv and getinfo: the compiled scene holds what the text says, or is refused.
namespace lightwell::commands {
namespace {

const std::string materials = "void plastic red 0 0 5 .7 .1 .1 0 0\nvoid brightfunc dim 2 .5+.1*Px . 0 0\n"
                              "dim light lamp 0 0 3 10 10 10\nvoid alias crimson red\n";
const std::string surfaces = "red polygon quad 0 0 12 0 0 0 1 0 0 1 2 .5 0 2 .5\nlamp sphere ball 0 0 4 1 2 3 .5\n"
                             "crimson cone c 0 0 8 0 0 0 0 0 1 .5 .2\nred ring r 0 0 8 1 1 1 0 0 1 .1 .4\n"
                             "lamp source sun 0 0 4 0 0 1 .5\n!genbox red box 1 2 3 | xform -t 5 0 0\n";

Scene read(const std::string& name)
{
    Report report;
    return read_radiance_sources({{name}}, report).scene;
}

std::string modifier_name(const Scene& scene, const Surface& surface)
{
    return surface.modifier == void_modifier ? "void"
                                             : scene.modifiers[static_cast<std::size_t>(surface.modifier)].name;
}

void expect_same(const Scene& a, const Scene& b)
{
    ASSERT_EQ(a.root.surfaces.size(), b.root.surfaces.size());
    for (std::size_t i = 0; i < a.root.surfaces.size(); ++i) {
        const Surface &x = a.root.surfaces[i], &y = b.root.surfaces[i];
        EXPECT_EQ(x.shape, y.shape);
        EXPECT_EQ(x.index, y.index);
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(modifier_name(a, x), modifier_name(b, y));
    }
    EXPECT_EQ(a.root.points, b.root.points);
    EXPECT_EQ(a.prototypes.size(), b.prototypes.size());
    EXPECT_EQ(expanded_count(a), expanded_count(b));
}

void compile(const std::string& line, const std::string& file, const std::string& input = {})
{
    const Ran ran = run(line, input);
    ASSERT_EQ(ran.status, 0) << ran.err;
    std::ofstream(file, std::ios::binary) << ran.out;
}

TEST(CompiledScenes, HoldWhatTheTextSaysToTheBit)
{
    const WorkFolder folder;
    folder.write("m.rad", materials);
    folder.write("s.rad", surfaces);
    folder.write("both.rad", materials + surfaces);
    compile("oconv -f m.rad s.rad", "x.oct");
    expect_same(read("x.oct"), read("both.rad"));
    compile("oconv -", "stdin.oct", materials + surfaces);
    expect_same(read("stdin.oct"), read("both.rad"));
    // The sources may go once the scene is frozen.
    for (const char* name : {"m.rad", "s.rad"})
        std::filesystem::remove(name);
    expect_same(read("x.oct"), read("both.rad"));
}

TEST(CompiledScenes, GrowWithTheNamesTheyKnow)
{
    const WorkFolder folder;
    folder.write("m.rad", materials);
    folder.write("s.rad", surfaces);
    folder.write("both.rad", materials + surfaces);
    compile("oconv -f m.rad", "m.oct");
    compile("oconv -f -i m.oct s.rad", "x.oct");
    expect_same(read("x.oct"), read("both.rad"));
    const Ran info = run("getinfo x.oct");
    EXPECT_EQ(info.out,
              "x.oct:\n\t#?RADIANCE\n\toconv -f m.rad\n\toconv -f -i m.oct s.rad\n\tFORMAT=Radiance_octree\n\t\n");
}

TEST(CompiledScenes, AreReadAgainWhenTheirSourcesChange)
{
    const WorkFolder folder;
    folder.write("a.rad", materials + "red sphere s 0 0 4 0 0 0 1\n");
    compile("oconv a.rad", "a.oct");
    compile("oconv -f a.rad", "frozen.oct");
    folder.write("a.rad", materials + "red sphere s 0 0 4 0 0 0 2.5\n");
    EXPECT_EQ(read("a.oct").root.spheres.at(0).radius, 2.5);
    EXPECT_EQ(read("frozen.oct").root.spheres.at(0).radius, 1);
    std::filesystem::remove("a.rad");
    EXPECT_EQ(read("a.oct").root.spheres.at(0).radius, 1);
}

TEST(CompiledScenes, StandInForInstances)
{
    const WorkFolder folder;
    folder.write("leaf.rad", "void plastic g 0 0 5 .1 .5 .1 0 0\ng sphere s 0 0 4 0 0 0 1\n");
    compile("oconv -f leaf.rad", "leaf.oct");
    std::filesystem::remove("leaf.rad");
    folder.write("tree.rad", "void instance a 5 leaf.oct -t 5 0 0 0 0\nvoid instance b 1 leaf.oct 0 0\n");
    const Scene scene = read("tree.rad");
    EXPECT_EQ(scene.prototypes.size(), 1u);
    EXPECT_EQ(expanded_count(scene), 2u);
    compile("oconv -f tree.rad", "tree.oct");
    expect_same(read("tree.oct"), scene);
}

TEST(CompiledScenes, AnyDamageIsNamed)
{
    const WorkFolder folder;
    folder.write("a.rad", materials + surfaces);
    compile("oconv -f a.rad", "a.oct");
    const std::string whole = WorkFolder::read("a.oct");
    const std::size_t body = whole.find("LWscene");
    for (std::size_t cut = body + 8; cut < whole.size(); cut += 37) {
        folder.write("b.oct", whole.substr(0, cut));
        EXPECT_THROW(read("b.oct"), InputError) << cut;
    }
    for (std::size_t at = body + 8; at < whole.size(); at += 11) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        folder.write("b.oct", damaged);
        EXPECT_THROW(read("b.oct"), InputError) << at;
    }
}

/// With its checksum made to fit again.
std::string forged(std::string compiled, std::size_t at, char byte)
{
    using namespace scene_text;
    const std::size_t body = compiled.find(compiled_mark) + compiled_mark.size();
    const std::size_t tail = compiled.size() - compiled_end.size() - 2 * sizeof(std::uint64_t);
    compiled[at] = byte;
    ByteSum sum;
    sum.add(compiled.data() + body, tail - body);
    const std::uint64_t value = sum.sum();
    std::memcpy(compiled.data() + tail, &value, sizeof value);
    return compiled;
}

TEST(CompiledScenes, PartsThatAreMadeOfEachOtherInARingAreRefused)
{
    const WorkFolder folder;
    folder.write("leaf.rad", "void plastic g 0 0 5 .1 .5 .1 0 0\ng sphere s 0 0 4 0 0 0 1\n");
    folder.write("twig.rad", "void instance a 5 leaf.rad -t 5 0 0 0 0\n");
    folder.write("tree.rad", "void instance b 5 twig.rad -t 0 5 0 0 0\n");
    const std::string whole = run("oconv -f tree.rad").out;
    for (const char* name : {"leaf.rad", "twig.rad"})
        std::filesystem::remove(name);
    folder.write("forest.rad", "void plastic g 0 0 5 .1 .5 .1 0 0\ng instance c 1 forged.oct 0 0\n");
    int rings = 0;
    for (std::size_t at = whole.find("LWscene"); at + 32 < whole.size(); ++at)
        if (whole[at] == 0 || whole[at] == 1) {
            std::ofstream("forged.oct", std::ios::binary) << forged(whole, at, whole[at] == 0 ? 1 : 2);
            const Ran ran = run("oconv -f forest.rad");
            rings += ran.err.find("made of one that does not come before it") != std::string::npos ? 1 : 0;
        }
    EXPECT_GE(rings, 2);
}

TEST(CompiledScenes, NumbersThatPointBeyondTheirListsAreRefusedThoughTheChecksumFits)
{
    using namespace scene_text;
    const WorkFolder folder;
    folder.write("a.rad", "void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n"
                          "grey sphere s 0 0 4 0 0 1 .2\n");
    const std::string whole = run("oconv -f a.rad").out;
    const std::size_t body = whole.find(compiled_mark) + compiled_mark.size();
    const std::size_t tail = whole.size() - compiled_end.size() - 2 * sizeof(std::uint64_t);
    int refused = 0;
    for (std::size_t at = body; at < tail; ++at) {
        const std::string changed = forged(whole, at, '\x7d');
        Report report;
        try {
            validate(read_radiance_sources({{"a.oct", changed}}, report).scene);
        } catch (const InputError& error) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

TEST(CompiledScenes, BadWordsAndScenesLeaveNothingBehind)
{
    const WorkFolder folder;
    folder.write("bad.rad", "gone polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n");
    folder.write("ok.rad", materials);
    for (const char* line :
         {"oconv -q ok.rad", "oconv gone.rad", "oconv bad.rad", "oconv -i ok.rad bad.rad", "oconv -b 0 0 0 -1 ok.rad",
          "oconv -b 5 5 5 1 good.rad", "getinfo bad.rad", "getinfo gone.oct"}) {
        const Ran ran = run(std::string(line));
        EXPECT_NE(ran.status, 0) << line;
        EXPECT_NE(ran.err.find(": fatal - "), std::string::npos) << line << ": " << ran.err;
        EXPECT_TRUE(ran.out.empty()) << line;
    }
}

TEST(Getinfo, ShowsAddsReplacesAndStrips)
{
    const WorkFolder folder;
    const std::string file = "#?RADIANCE\nrpict x\nEXPOSURE=2\nFORMAT=ascii\n\nbody\nof it";
    EXPECT_EQ(run("getinfo", file).out, "#?RADIANCE\nrpict x\nEXPOSURE=2\nFORMAT=ascii\n\n");
    EXPECT_EQ(run("getinfo -", file).out, "body\nof it");
    EXPECT_EQ(run({"getinfo", "-a", "VIEW= -vta"}, file).out,
              "#?RADIANCE\nrpict x\nEXPOSURE=2\nVIEW= -vta\nFORMAT=ascii\n\nbody\nof it");
    EXPECT_EQ(run({"getinfo", "-r", "EXPOSURE=16"}, file).out,
              "#?RADIANCE\nrpict x\nEXPOSURE=16\nFORMAT=ascii\n\nbody\nof it");
    folder.write("a.rad", "void light l 0 0 3 1 1 1\nl sphere s 0 0 4 1 2 3 .5\n");
    compile("oconv -f a.rad", "a.oct");
    EXPECT_EQ(difference(run("getinfo -d a.oct").out, "a.oct: 0.49999 1.49999 2.49999 1.00002", 1e-6, 1e-9), "");
}

} // namespace
} // namespace lightwell::commands
