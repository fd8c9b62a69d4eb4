#include "engine/base/errors.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/picture_stream.h"
#include "plugins/commands/run_header.h"
#include "plugins/commands/scene_files.h"
#include "plugins/commands/view_options.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <ostream>
#include <sys/resource.h>
#include <unistd.h>

namespace lightwell::commands {
namespace {

struct Wish {
    RadianceSettings settings;
    ViewOptions view;
    std::string octree, log, output, depth;
    double report_s = 0;
};

Wish wish_of(const std::vector<std::string>& words)
{
    Wish wish;
    wish.settings.ambient_accuracy = 0.2;
    wish.settings.ambient_divisions = 512;
    OptionReader reader(words);
    while (reader.more() && reader.peek().size() > 1 && reader.peek()[0] == '-') {
        if (wish.view.read(reader) || read_setting(reader, wish.settings))
            continue;
        const std::string word = reader.take();
        if (word == "-t")
            wish.report_s = reader.number(word);
        else if (word == "-e")
            wish.log = reader.value(word);
        else if (word == "-o")
            wish.output = reader.value(word);
        else if (word == "-z")
            wish.depth = reader.value(word);
        else if (word == "-ps" || word == "-pt" || word == "-pj" || word == "-P" || word == "-PP")
            reader.value(word); // every pixel has samples of its own, spread over its area
        else if (word != "-pRGB" && word != "-pXYZ")
            throw Fatal("command line error at '" + word + "'");
        if (word == "-pXYZ")
            throw Fatal("pictures in XYZ are not written; use -pRGB");
    }
    if (reader.more())
        wish.octree = reader.take();
    if (reader.more())
        throw Fatal("command line error at '" + reader.take() + "'");
    return wish;
}

/// Lines that say how far it has come, in the form that other programs look for.
class Reports {
public:
    Reports(std::ostream& out, double interval_s) : out_(out), interval_s_(interval_s) {}
    Progress progress()
    {
        Progress progress;
        progress.report = [this](const std::string& stage, double fraction) {
            const double now = seconds_since(start_);
            if (interval_s_ <= 0 || now - last_s_ < interval_s_ || stage.rfind("view", 0) != 0)
                return;
            last_s_ = now;
            line(0, fraction);
        };
        return progress;
    }
    void finish(std::size_t rays)
    {
        if (interval_s_ > 0)
            line(rays, 1);
    }

private:
    using Clock = std::chrono::steady_clock;
    static double seconds_since(Clock::time_point start)
    {
        return std::chrono::duration<double>(Clock::now() - start).count();
    }
    void line(std::size_t rays, double fraction)
    {
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        const auto hours = [](const timeval& t) {
            return (static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6) / 3600;
        };
        char host[256] = "";
        gethostname(host, sizeof host - 1);
        out_ << fmt::format("rpict: {} rays, {:.2f}% after {:.3f}u {:.3f}s {:.3f}r hours on {} (PID {})\n", rays,
                            100 * fraction, hours(usage.ru_utime), hours(usage.ru_stime), seconds_since(start_) / 3600,
                            host, getpid());
        out_.flush();
    }

    std::ostream& out_;
    double interval_s_, last_s_ = 0;
    Clock::time_point start_ = Clock::now();
};

/// What Radiance's `-i` shows: the irradiance of surfaces in place of their radiance.
void show_irradiance(Picture& picture)
{
    const std::vector<float>& illuminance = picture.channels.at("illuminance.Y");
    for (const char* channel : {"R", "G", "B"})
        for (std::size_t i = 0; i < illuminance.size(); ++i)
            picture.channels.at(channel)[i] = illuminance[i] / static_cast<float>(lumens_per_watt);
}

void write_depth(const Picture& picture, const std::string& name)
{
    const std::vector<float>& depth = picture.channels.at("Z");
    std::ofstream out(name, std::ios::binary);
    out.write(reinterpret_cast<const char*>(depth.data()), static_cast<std::streamsize>(depth.size() * sizeof(float)));
    if (!out.flush())
        throw Fatal("cannot write \"" + name + "\"");
}

void render(const std::vector<std::string>& words, const Wish& asked, std::ostream& err, const Streams& streams)
{
    Wish wish = asked;
    const View view = wish.view.view();
    wish.view.fit(view);
    LoadedScene loaded = load_scene(wish.octree, streams);
    if (wish.settings.warnings)
        write_warnings(words[0], loaded.report, err);
    const RaySettings of_rays = ray_settings(wish.settings);
    Reports reports(err, wish.report_s);
    PictureSettings settings;
    settings.width = wish.view.columns;
    settings.height = wish.view.rows;
    settings.accuracy = of_rays.accuracy;
    settings.unbiased = of_rays.unbiased;
    settings.threads = of_rays.threads;
    settings.ambient_file = of_rays.ambient_file;
    PictureResult result =
        Simulation(std::move(loaded.scene), preparation_for(wish.settings)).render(view, settings, reports.progress());
    Picture& picture = result.picture;
    if (wish.settings.irradiance)
        show_irradiance(picture);
    picture.header = {{"history", run_history(loaded.header, words)}, {"VIEW", to_text(view)}};
    const double aspect = wish.view.columns / (Camera(view).aspect() * wish.view.rows);
    constexpr double square = 0.005; // what rounding to whole pixels makes
    if (!(std::fabs(aspect - 1) < square))
        picture.header["PIXASPECT"] = fmt::format(" {:f}", aspect);
    if (!wish.depth.empty())
        write_depth(picture, wish.depth);
    if (wish.output.empty()) {
        write_picture(picture, streams.out);
    } else {
        std::ofstream file(wish.output, std::ios::binary);
        write_picture(picture, file);
        if (!file.flush())
            throw Fatal("cannot write \"" + wish.output + "\"");
    }
    reports.finish(result.work.rays().total());
}

} // namespace

/// rpict: a picture of a compiled scene on standard output.
int rpict(const std::vector<std::string>& words, const Streams& streams)
{
    if (words.size() == 2 && words[1] == "-defaults") {
        streams.out << picture_defaults();
        return 0;
    }
    const Wish wish = wish_of(words);
    if (wish.log.empty()) {
        render(words, wish, streams.err, streams);
        return 0;
    }
    // Whoever gives a log looks for errors there.
    std::ofstream log(wish.log, std::ios::app);
    try {
        render(words, wish, log, streams);
    } catch (const std::exception& error) {
        log << words[0] << ": fatal - " << error.what() << std::endl;
        throw;
    }
    return 0;
}

} // namespace lightwell::commands
