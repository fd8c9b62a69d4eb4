/// \file Radiance's own test scenes against pictures that Radiance made of them, by the rule that goes with them.
#include "engine/pictures/rgbe.h"
#include "engine/simulate/simulate.h"
#include "importers/radiance/radiance.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace lightwell {
namespace {

namespace fs = std::filesystem;

/// Samples across for each pixel of the reference: the rule wants at least four. Where Radiance's own picture of so
/// many does not agree with its reference, the views need as many as the reference had.
constexpr int usual_oversampling = 4, fine_oversampling = 16;
/// Differences are relative to at least this, and their root mean square stays below the second number.
constexpr double least_brightness = 0.007, most_rms = 0.1, most_single = 1.5;

fs::path scenes_folder()
{
    const char* elsewhere = std::getenv("LIGHTWELL_SHARED");
    return fs::path(elsewhere != nullptr ? elsewhere : LIGHTWELL_ROOT "/../shared") / "reference/radiance-renders";
}

/// Gaussian of one reference pixel's radius, cut to a square of two each way: the filter that the references went
/// through (the answer of `pfilt -r 1` to a single bright sample).
Picture reduced(const Picture& fine, int width, int height)
{
    Picture coarse;
    coarse.width = width;
    coarse.height = height;
    const double across = static_cast<double>(fine.width) / width, down = static_cast<double>(fine.height) / height;
    constexpr double cut = 2;
    for (const char* channel : {"R", "G", "B"}) {
        std::vector<float>& values = coarse.add_channel(channel);
        const std::vector<float>& samples = fine.channels.at(channel);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double cx = (x + 0.5) * across, cy = (y + 0.5) * down;
                double sum = 0, weights = 0;
                for (int j = std::max(0, static_cast<int>(cy - cut * down)); j < fine.height && j < cy + cut * down;
                     ++j)
                    for (int i = std::max(0, static_cast<int>(cx - cut * across));
                         i < fine.width && i < cx + cut * across; ++i) {
                        const double dx = (i + 0.5 - cx) / across, dy = (j + 0.5 - cy) / down;
                        const double weight = std::exp(-dx * dx - dy * dy);
                        sum += weight * static_cast<double>(samples[static_cast<std::size_t>(j * fine.width + i)]);
                        weights += weight;
                    }
                values[static_cast<std::size_t>(y * width + x)] = static_cast<float>(sum / weights);
            }
    }
    return coarse;
}

struct Difference {
    double rms = 0, most = 0, mean_ours = 0, mean_reference = 0;
};

/// For each pixel the mean of the channels and the largest channel of the reference.
Difference difference(const Picture& reference, const Picture& ours, double exposure)
{
    Difference found;
    const auto add = [&](double r, double o) {
        const double d = (o - r) / std::max((std::fabs(r) + std::fabs(o)) / 2, least_brightness);
        found.rms += d * d;
        found.most = std::max(found.most, std::fabs(d));
    };
    const int count = reference.width * reference.height;
    for (int i = 0; i < count; ++i) {
        const int x = i % reference.width, y = i / reference.width;
        double r[3], o[3];
        for (int c = 0; c < 3; ++c) {
            const std::string channel(1, "RGB"[c]);
            r[c] = static_cast<double>(reference.at(channel, x, y)) * exposure;
            o[c] = static_cast<double>(ours.at(channel, x, y)) * exposure;
        }
        const auto largest = std::max_element(r, r + 3) - r;
        const double mean_r = (r[0] + r[1] + r[2]) / 3, mean_o = (o[0] + o[1] + o[2]) / 3;
        add(mean_r, mean_o);
        add(r[largest], o[largest]);
        found.mean_reference += mean_r / count;
        found.mean_ours += mean_o / count;
    }
    found.rms = std::sqrt(found.rms / (2.0 * count));
    return found;
}

/// Pictures as seen, for whoever looks into a difference.
void keep(const Picture& picture, const std::string& name)
{
    if (const char* folder = std::getenv("LIGHTWELL_KEEP_PICTURES"))
        write_rgbe(picture, fs::path(folder) / (name + ".hdr"));
}

int oversampling_of(const nlohmann::json& view)
{
    const auto rerun = view.find("peer_rerun_512");
    const bool fine = rerun != view.end() && rerun->value("rms", 0.0) >= most_rms;
    return fine ? fine_oversampling : usual_oversampling;
}

/// Paths of each sample: few, for a test that is run often, or as many as LIGHTWELL_REFERENCE_PATHS says.
int paths_per_sample()
{
    constexpr int few = 1;
    const char* wish = std::getenv("LIGHTWELL_REFERENCE_PATHS");
    return wish != nullptr ? std::max(1, std::atoi(wish)) : few;
}

class RadianceRender : public testing::TestWithParam<const char*> {};

/// Scenes and views that agree, the quickest views of each alone by default. README.md says by how much the others
/// differ, and why.
bool known_to_agree(const std::string& scene, const std::string& view = "")
{
    constexpr std::pair<std::string_view, std::string_view> agreeing[] = {
        {"patterns", "def"}, {"mesh", "def"},  {"spectra", "fish"}, {"tfunc", "def"},
        {"glass", "up"},     {"inst", "fish"}, {"trans", "def"}};
    return std::any_of(std::begin(agreeing), std::end(agreeing), [&](const auto& known) {
        return known.first == scene && (view.empty() || known.second == view);
    });
}

bool all_wanted()
{
    return std::getenv("LIGHTWELL_REFERENCE_ALL") != nullptr;
}

TEST_P(RadianceRender, AgreesWithThePictureThatRadianceMade)
{
    if (!known_to_agree(GetParam()) && !all_wanted())
        GTEST_SKIP() << "this scene differs from Radiance's picture, see tests/reference/README.md";
    const fs::path folder = scenes_folder() / GetParam();
    if (!fs::exists(folder))
        GTEST_SKIP() << "the reference pictures are not beside the repository";
    ::setenv("RAYPATH", (folder.string() + ":" + (folder / "../common").string()).c_str(), 1);
    std::ifstream text(folder / "scene.json");
    const nlohmann::json about = nlohmann::json::parse(text);
    Report report;
    Preparation preparation;
    preparation.ambient_limit = AmbientLimit{};
    const auto& settings = about["settings"];
    preparation.ambient_limit->bounces = settings["ambient_bounces"];
    const auto& av = settings["ambient_value"];
    preparation.ambient_limit->radiance = {av[0], av[1], av[2]};
    preparation.ambient_limit->unsampled_specularity = settings["specular_threshold"];
    preparation.virtual_depth = settings["virtual_source_relays"];
    preparation.backs_unseen = !settings.value("back_face_visibility", true);
    const Simulation simulation(read_radiance(folder / "scene.rad", report), preparation);
    for (const auto& described : about["views"]) {
        const std::string name = described["name"];
        if (!known_to_agree(GetParam(), name) && !all_wanted())
            continue;
        SCOPED_TRACE(name);
        const std::string words = described["view"];
        const View view = parse_view(words, name);
        const std::string reference_name = described["reference"];
        Picture reference = read_rgbe(folder / reference_name);
        // The file says that it was exposed; the numbers that are compared are those with the exposure.
        const double exposure = about["exposure"];
        PictureSettings picture;
        const int oversampling = oversampling_of(described);
        picture.width = reference.width * oversampling;
        picture.height = reference.height * oversampling;
        picture.samples = oversampling == fine_oversampling ? 1 : paths_per_sample();
        picture.unbiased = true;
        const Picture ours = reduced(simulation.render(view, picture).picture, reference.width, reference.height);
        const Difference found = difference(reference, ours, exposure);
        keep(ours, std::string(GetParam()) + "_" + name);
        std::printf("%s %s: rms %.4f, most %.3f, mean %.5f, of the reference %.5f (%+.2f %%)\n", GetParam(),
                    name.c_str(), found.rms, found.most, found.mean_ours, found.mean_reference,
                    100 * (found.mean_ours / found.mean_reference - 1));
        const double noise = described.value("noise_rms_of_reference", 0.0);
        EXPECT_LT(found.rms, std::sqrt(most_rms * most_rms + noise * noise));
        if (described.value("max_between_two_runs", 0.0) < most_single) {
            EXPECT_LT(found.most, most_single);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, RadianceRender,
                         testing::Values("glass", "inst", "mesh", "mirror", "mist", "mixtex", "patterns", "prism1",
                                         "spectra", "tfunc", "trans"),
                         [](const auto& scene) { return std::string(scene.param); });

} // namespace
} // namespace lightwell
