/// \file Materials whose scattering is told by functions: they are asked at a place, then behave as all others.
#include "materials/patterns/pattern_reader.h"
#include "materials/placed.h"
#include "tests/unit/materials/bsdf_measures.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace lightwell {
namespace {

/// Functions of a material, from words as scene text has them and one function file.
class FunctionFile {
public:
    explicit FunctionFile(const std::string& text)
    {
        static int number = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("functional_test_" + std::to_string(::getpid()) + "_" + std::to_string(number++) + ".cal");
        std::ofstream(path_) << text;
    }
    ~FunctionFile() { std::filesystem::remove(path_); }
    std::shared_ptr<const PlaceProgram> functions(const std::string& type, std::vector<std::string> words,
                                                  std::vector<double> numbers) const
    {
        PatternReader::Request request;
        request.type = type;
        words.push_back(path_.string());
        request.words = std::move(words);
        request.numbers = std::move(numbers);
        request.place = "test";
        request.find_file = [](const std::string& name) -> std::optional<std::filesystem::path> {
            return std::filesystem::exists(name) ? std::optional<std::filesystem::path>(name) : std::nullopt;
        };
        request.read_transform = [](const auto&, std::size_t) { return Affine{}; };
        return PatternReader().read_material(request).functions;
    }

private:
    std::filesystem::path path_;
};

/// Ward's bounded lobe, written as a function: symmetric in the directions of viewer and light.
constexpr const char* ward = "hx(x) = x - Dx; hy(y) = y - Dy; hz(z) = z - Dz;\n"
                             "tan2(x, y, z) = (sq(hx(x)) + sq(hy(y))) / sq(hz(z));\n"
                             "lobe(x, y, z) = if(z * -Dz, Exp(-tan2(x, y, z) / A5 / A5) * "
                             "(sq(hx(x)) + sq(hy(y)) + sq(hz(z))) / (PI * A5 * A5 * hz(z) ^ 4), 0);\n";

Functional placed(Functional material, const Direction& to_viewer)
{
    Material made = material;
    PatternPlace place;
    place.direction = -to_viewer;
    put_in_place(made, place);
    return std::get<Functional>(made);
}

Functional ward_by_function(Functional::Kind kind, const char* word, double specularity)
{
    const FunctionFile file(ward);
    Functional made;
    made.kind = kind;
    made.colour = {0.6, 0.4, 0.2};
    made.specularity = specularity;
    made.function = file.functions(word, {"lobe"}, {0.6, 0.4, 0.2, specularity, 0.3});
    return made;
}

TEST(Functional, AFunctionThatIsWardsLobeScattersAsWardsLobe)
{
    const Functional plastic = ward_by_function(Functional::Kind::plasfunc, "plasfunc", 0.3);
    const Functional metal = ward_by_function(Functional::Kind::metfunc, "metfunc", 0.9);
    const Material own_plastic = Plastic{{0.6, 0.4, 0.2}, 0.3, 0.3}, own_metal = Metal{{0.6, 0.4, 0.2}, 0.9, 0.3};
    for (const double angle : {0.0, 40.0, 75.0})
        for (const double light : {5.0, 50.0, 80.0}) {
            const Direction to_viewer = at(angle, 10), to_light = at(light, 170);
            for (const auto& [by_function, own] : {std::pair(&plastic, &own_plastic), std::pair(&metal, &own_metal)}) {
                const Material asked = placed(*by_function, to_viewer);
                const Spectrum found = Bsdf(asked, true).value_per_sr(to_viewer, to_light);
                const Spectrum expected = Bsdf(*own, true).value_per_sr(to_viewer, to_light);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(found[c], expected[c], 1e-9 * (1 + expected[c])) << angle << " " << light;
            }
        }
}

TEST(Functional, SamplesFollowTheDensityAndCarryTheIntegralOfTheValue)
{
    const Functional plastic = ward_by_function(Functional::Kind::plasfunc, "plasfunc", 0.3);
    Functional sheet = ward_by_function(Functional::Kind::transfunc, "transfunc", 0.2);
    sheet.transmission = 0.7;
    sheet.transmitted_specular = 0.4;
    for (const Functional& material : {plastic, sheet})
        for (const double angle : {0.0, 45.0, 80.0}) {
            SCOPED_TRACE(angle);
            const Direction to_viewer = at(angle, 7);
            const Material asked = placed(material, to_viewer);
            const Bsdf bsdf(asked, true);
            const Histogram found = histogram_of(bsdf, to_viewer);
            EXPECT_GT(probability(found, shares_of(bsdf, to_viewer)), 1e-7);
            RunningStatistics uniform, drawn;
            RandomStream random(9);
            for (int i = 0; i < 200000; ++i) {
                const Direction d = uniform_sphere(random.square());
                uniform.add(4 * pi * bsdf.value_per_sr(to_viewer, d).g * std::fabs(d.z));
                const double choice = random.next();
                const auto s = bsdf.sample(to_viewer, choice, random.square());
                drawn.add(s ? s->weight.g : 0);
            }
            EXPECT_TRUE(
                agrees({uniform.mean(), std::hypot(uniform.standard_error(), drawn.standard_error())}, drawn.mean()))
                << uniform.mean() << " " << drawn.mean();
        }
}

TEST(Functional, WhatSendsBackMoreThanItGetsIsScaledDown)
{
    const FunctionFile file("bright(x, y, z) = 2;");
    Functional made;
    made.specularity = 1;
    made.function = file.functions("plasfunc", {"bright"}, {1, 1, 1, 1});
    // The integral of 2 cos over the hemisphere is 2 pi.
    EXPECT_NEAR(bounded_scale(made) * 2 * pi, 1, 0.05);
    EXPECT_EQ(bounded_scale(ward_by_function(Functional::Kind::plasfunc, "plasfunc", 0.3)), 1);
}

TEST(Functional, BrtdfuncMirrorsAndPassesByTheSharesOfThePlace)
{
    const FunctionFile file("share = .5 * Rdot;");
    Functional made;
    made.kind = Functional::Kind::BRTDfunc;
    made.front = Spectrum::grey(0.1);
    made.function = file.functions("BRTDfunc", {"share", ".1", ".1", ".2", ".3", "share", "0", "0", "0"},
                                   {.1, .1, .1, 0, 0, 0, 0, 0, 0});
    const Material asked = placed(made, at(60));
    const Bsdf bsdf(asked, true);
    EXPECT_NEAR(bsdf.straight_transmittance(at(60)).r, 0.2, 1e-12);
    EXPECT_NEAR(bsdf.straight_transmittance(at(60)).b, 0.25, 1e-12);
    EXPECT_NEAR(albedo(bsdf, at(60), 200000).r, 0.25 + 0.2 + 0.1, 0.005);
}

TEST(Placed, TheGrainTurnsTheFrame)
{
    const FunctionFile file("");
    const Material brushed = Brushed{Brushed::Kind::metal,
                                     Spectrum::grey(1),
                                     1,
                                     0.05,
                                     0.3,
                                     0,
                                     0,
                                     {file.functions("metal2", {"1", "1", "0"}, {}), {}}};
    Material asked = brushed;
    put_in_place(asked, {});
    const Frame frame = frame_of(asked, {0, 0, 1});
    EXPECT_NEAR(frame.x.x, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(frame.x.y, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(dot(cross(frame.x, frame.y), frame.z), 1, 1e-12);
}

TEST(Placed, FunctionsThatFailAreZeroAndDamageIsRefused)
{
    const FunctionFile file("bad(x, y, z) = 1 / (x - x);");
    Functional made;
    made.specularity = 1;
    made.function = file.functions("plasfunc", {"bad"}, {1, 1, 1, 1});
    const Material asked = placed(made, at(10));
    EXPECT_TRUE(Bsdf(asked, true).value_per_sr(at(10), at(30)).is_black());
    EXPECT_ANY_THROW(file.functions("plasfunc", {"missing"}, {1, 1, 1, 1}));
    EXPECT_ANY_THROW(file.functions("BRTDfunc", {".1", ".1"}, {}));
}

} // namespace
} // namespace lightwell
