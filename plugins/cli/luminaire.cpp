#include "engine/scene/luminaire.h"

#include "engine/base/errors.h"
#include "engine/base/spectrum.h"
#include "engine/base/text.h"
#include "importers/radiance/radiance.h"
#include "plugins/cli/luminaire_picture.h"
#include "plugins/cli/subcommands.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace lightwell {
namespace {

struct LuminaireOptions {
    std::string file, picture, scene;
    std::vector<double> aim{0, 0, -1}, body{0, 0, 0}, colour{1, 1, 1};
    double turn_deg = 0, share = 1;
    bool json = false;
};

constexpr const char* examples = R"(Examples:
  lightwell luminaire panel.ies                         flux, intensities, opening
  lightwell luminaire panel.ldt -o panel.png            polar plot
  lightwell luminaire flood.ies -o flood.png --aim 0.3,0,-1 --turn 90
  lightwell luminaire panel.ies --scene panel.rad       to be placed by `instance` or `!xform`
In a layer map: luminaire = "panel.ies" in a rule, with aim = [x, y, z] and turn = DEGREES.)";

std::string opening_text(const Photometry::Opening& opening)
{
    const std::string shape = to_text(opening.shape);
    return opening.shape == Photometry::Opening::Shape::point
               ? shape
               : fmt::format("{}, {:.3g} x {:.3g} x {:.3g} m", shape, opening.x_m, opening.y_m, opening.z_m);
}

const char* type_text(Photometry::Type type)
{
    return type == Photometry::Type::C ? "C" : type == Photometry::Type::B ? "B" : "A";
}

void print_table(const Photometry& p, std::ostream& out)
{
    const double lumens = p.lumens();
    const auto line = [&](const char* what, const std::string& value) {
        out << fmt::format("{:<22}{}\n", what, value);
    };
    line("name", p.name);
    line("flux", fmt::format("{:.1f} lm", lumens));
    line("lamps", p.lamp_lumens > 0 ? fmt::format("{:.1f} lm, of which {:.1f} % leave the luminaire", p.lamp_lumens,
                                                  100 * lumens / p.lamp_lumens)
                                    : "absolute photometry");
    if (p.watts > 0)
        line("power", fmt::format("{:.1f} W, {:.1f} lm/W", p.watts, lumens / p.watts));
    line("greatest intensity", fmt::format("{:.1f} cd", p.greatest_candela()));
    line("beam, half intensity",
         fmt::format("{:.1f} degrees in plane 0, {:.1f} in plane 90", p.beam_angle_deg(0), p.beam_angle_deg(90)));
    line("luminous opening", opening_text(p.opening) + " (plane 0, plane 90, height)");
    line("table",
         fmt::format("type {}, {} x {} angles", type_text(p.type), p.horizontal_deg.size(), p.vertical_deg.size()));
}

void print_json(const Photometry& p, std::ostream& out)
{
    out << nlohmann::ordered_json{{"name", p.name},
                                  {"lumens", p.lumens()},
                                  {"lamp_lumens", p.lamp_lumens},
                                  {"watts", p.watts},
                                  {"greatest_candela", p.greatest_candela()},
                                  {"beam_angle_deg", {p.beam_angle_deg(0), p.beam_angle_deg(90)}},
                                  {"opening", to_text(p.opening.shape)},
                                  {"opening_m", {p.opening.x_m, p.opening.y_m, p.opening.z_m}},
                                  {"type", type_text(p.type)}}
               .dump(2)
        << '\n';
}

/// The luminaire in its own frame, so that whoever places it turns it.
void write_scene(const Photometry& photometry, const LuminaireOptions& options, const Vec3& aim, Report& report)
{
    const Vec3 size{options.body[0], options.body[1], options.body[2]};
    if (!is_finite(size) || size.x < 0 || size.y < 0 || size.z < 0)
        throw InputError{"--body", "is no size", "three lengths in metres, at least 0, for example 0.6,0.6,0.05"};
    const double tilt_deg = std::acos(std::clamp(-normalized(aim).z, -1.0, 1.0)) / radians_per_degree;
    const std::filesystem::path file = options.scene;
    const Vec3 colour{options.colour[0], options.colour[1], options.colour[2]};
    if (!is_finite(colour) || colour.x < 0 || colour.y < 0 || colour.z < 0)
        throw InputError{"--colour", "is no colour", "three numbers, at least 0, for example 1.2,0.95,0.6"};
    const LuminaireLook look{file.stem().string(), true, options.share * photometry.share_tilted(tilt_deg), size * 0.5,
                             Spectrum{colour.x, colour.y, colour.z}};
    Scene scene;
    scene.root = luminaire_part(scene, photometry, look, report);
    write_radiance(scene, file, {}, report);
}

Status luminaire(const LuminaireOptions& options, std::ostream& out, std::ostream& err)
{
    Report report;
    const Photometry photometry = read_photometry(options.file, report);
    const Vec3 aim{options.aim[0], options.aim[1], options.aim[2]};
    if (!(length(aim) > 0) || !is_finite(aim))
        throw InputError{"--aim", "is no direction", "three numbers, for example 0,0.3,-1"};
    if (options.json)
        print_json(photometry, out);
    else
        print_table(photometry, out);
    if (!options.picture.empty())
        write_png(luminaire_picture(photometry, luminaire_frame(aim, options.turn_deg)), options.picture);
    if (!options.scene.empty())
        write_scene(photometry, options, aim, report);
    err << report;
    return Status::done;
}

} // namespace

/// lightwell luminaire FILE [-o PICTURE.png] [--aim X,Y,Z] [--turn DEGREES] [--scene NAME.rad] [--json]: what a
/// photometric file holds.
void add_luminaire(CLI::App& app, Status& status)
{
    auto options = std::make_shared<LuminaireOptions>();
    CLI::App& command = *app.add_subcommand("luminaire", "flux, intensities and opening of an IES or EULUMDAT file");
    command.add_option("file", options->file, "IES LM-63 or EULUMDAT")->required()->check(CLI::ExistingFile);
    command.add_option("-o,--output", options->picture, "polar plot, aim and rotation as PNG");
    command.add_option("--aim", options->aim, "where its light goes in the picture")->delimiter(',')->expected(3);
    command.add_option("--turn", options->turn_deg, "degrees about its axis")->check(CLI::Range(-360, 360));
    command.add_option("--scene", options->scene,
                       "its luminous opening as scene text, light towards -z, plane 0 along +x; --aim tells its tilt");
    command
        .add_option("--body", options->body, "size in metres of a body about the origin that must not stand in the way")
        ->delimiter(',')
        ->expected(3);
    command
        .add_option("--colour", options->colour, "of its light: red, green, blue; luminance 1 keeps the intensities")
        ->delimiter(',')
        ->expected(3);
    command.add_option("--share", options->share, "factor on the light")->check(CLI::Range(1e-9, 1e9));
    command.add_flag("--json", options->json, "for programs");
    command.footer(examples);
    command.callback([options, &status] { status = luminaire(*options, std::cout, std::cerr); });
}

} // namespace lightwell
