#include "engine/base/errors.h"
#include "plugins/commands/command_list.h"
#include "plugins/commands/radiance_settings.h"
#include "plugins/commands/records.h"
#include "plugins/commands/run_header.h"
#include "plugins/commands/scene_files.h"

#include <cmath>
#include <fstream>
#include <memory>
#include <ostream>

namespace lightwell::commands {
namespace {

/// So many rays are traced together: they share the search for ambient light, and the answers need not wait for ever.
constexpr std::size_t rays_together = 1 << 20;

struct Wish {
    RadianceSettings settings;
    std::string outputs = "v", octree, log;
    NumberFormat in = NumberFormat::text, out = NumberFormat::text;
    bool header = true, sensors = false, limited = false;
    int columns = 0, rows = 0;
};

void read_formats(const std::string& word, Wish& wish)
{
    const char letter = word.size() > 2 ? word[2] : 'a';
    wish.in = number_format(letter, word, false);
    wish.out = word.size() > 3 ? number_format(word[3], word, true) : wish.in;
    if (word.size() > 4)
        throw Fatal("command line error at '" + word + "'");
}

bool read_own_option(const std::string& word, OptionReader& words, Wish& wish)
{
    const auto flag = [&](const char* name, bool& value) {
        const auto on = switch_of(word, name, value);
        value = on.value_or(value);
        return on.has_value();
    };
    if (flag("-h", wish.header) || flag("-ld", wish.limited))
        return true;
    if (word == "-I" || word == "-I+" || word == "-I-" || word == "-I1" || word == "-I0")
        return flag("-I", wish.sensors);
    if (word == "-x")
        wish.columns = words.integer(word);
    else if (word == "-y")
        wish.rows = words.integer(word);
    else if (word == "-e")
        wish.log = words.value(word);
    else if (word == "-t" || word == "-P" || word == "-PP")
        words.value(word);
    else if (word.rfind("-o", 0) == 0 && word.size() > 2)
        wish.outputs = word.substr(2);
    else if (word.rfind("-f", 0) == 0)
        read_formats(word, wish);
    else if (word != "-pRGB" && word != "-pY" && word != "-pS")
        return false;
    return true;
}

Wish wish_of(const std::vector<std::string>& words)
{
    Wish wish;
    wish.settings.ambient_accuracy = 0.1;
    OptionReader reader(words);
    while (reader.more() && reader.peek().size() > 1 && reader.peek()[0] == '-') {
        if (read_setting(reader, wish.settings))
            continue;
        const std::string word = reader.take();
        if (!read_own_option(word, reader, wish))
            throw Fatal("command line error at '" + word + "'");
    }
    if (reader.more())
        wish.octree = reader.take();
    if (reader.more())
        throw Fatal("command line error at '" + reader.take() + "'");
    if (wish.octree.empty())
        throw Fatal("missing octree argument");
    for (const char letter : wish.outputs)
        if (std::string_view("odvVwWlLpnNsmM").find(letter) == std::string_view::npos)
            throw Fatal(std::string("unrecognized output option '") + letter + "'");
    if (wish.out == NumberFormat::colours && wish.outputs != "v" && wish.outputs != "V")
        throw Fatal("-f?c format output is only meaningful for single color values");
    return wish;
}

/// One ray of the input; a direction of no length asks for nothing but what is there so far.
struct InputRay {
    RayRequest request;
    bool bogus = false;
};

std::optional<InputRay> read_ray(NumberInput& in, const Wish& wish)
{
    double values[6];
    for (int i = 0; i < 6; ++i) {
        const auto value = in.next();
        if (!value && i == 0)
            return std::nullopt;
        if (!value)
            throw Fatal("input ended within a ray: origin and direction are six numbers");
        values[i] = *value;
    }
    InputRay ray;
    ray.request.origin = {values[0], values[1], values[2]};
    const Vec3 direction{values[3], values[4], values[5]};
    const double size = length(direction);
    ray.bogus = !(size > 0) || !std::isfinite(size) || !is_finite(ray.request.origin);
    if (ray.bogus)
        return ray;
    ray.request.direction = normalized(direction);
    ray.request.sensor = wish.sensors;
    if (wish.limited)
        ray.request.reach_m = size;
    return ray;
}

class Answers {
public:
    Answers(const Wish& wish, const RayTracer& tracer, std::ostream& out)
        : wish_(wish), tracer_(tracer), out_(out, wish.out)
    {
    }

    void write(const InputRay& ray, const RayAnswer& answer)
    {
        for (const char letter : wish_.outputs)
            field(letter, ray, answer);
        out_.end();
    }

private:
    void field(char letter, const InputRay& ray, const RayAnswer& answer)
    {
        const Spectrum& value = wish_.settings.irradiance && !wish_.sensors ? answer.irradiance : answer.value;
        const double distance = answer.met_surface ? answer.distance_m : 0;
        switch (letter) {
        case 'o':
            return vector(ray.request.origin);
        case 'd':
            return vector(ray.bogus ? Vec3{} : ray.request.direction);
        case 'v':
        case 'V':
            return out_.colour({value.r, value.g, value.b});
        case 'W':
            return out_.colour({1, 1, 1});
        case 'w':
            return out_.number(1);
        case 'l':
        case 'L':
            return out_.number(distance);
        case 'p':
            return vector(answer.position);
        case 'n':
        case 'N':
            return vector(answer.normal);
        case 's':
            return out_.word(answer.met_surface ? answer.surface : "*");
        default:
            return out_.word(name_of(answer, letter == 'M'));
        }
    }

    std::string name_of(const RayAnswer& answer, bool material) const
    {
        ModifierId id = answer.modifier;
        const auto& modifiers = tracer_.scene().modifiers;
        while (material && id != void_modifier) {
            const Modifier& modifier = modifiers[static_cast<std::size_t>(id)];
            if (std::holds_alternative<Material>(modifier.what))
                break;
            const auto* alias = std::get_if<Alias>(&modifier.what);
            id = alias != nullptr ? alias->target : modifier.parent;
        }
        return id == void_modifier ? "*" : modifiers[static_cast<std::size_t>(id)].name;
    }

    void vector(const Vec3& v)
    {
        for (int axis = 0; axis < 3; ++axis)
            out_.number(v[axis]);
    }

    const Wish& wish_;
    const RayTracer& tracer_;
    NumberOutput out_;
};

void write_header(const std::vector<std::string>& words, const LoadedScene& loaded, const Wish& wish, std::ostream& out)
{
    if (wish.header)
        out << run_header(loaded.header, words) << (wish.out == NumberFormat::colours ? "" : "NCOMP=3\n")
            << (wish.out == NumberFormat::floats || wish.out == NumberFormat::doubles ? "BigEndian=0\n" : "")
            << "FORMAT=" << format_name(wish.out) << "\n\n";
    if (wish.out == NumberFormat::colours && wish.rows > 0 && wish.columns > 0)
        out << "-Y " << wish.rows << " +X " << wish.columns << '\n';
}

void trace_all(const Wish& wish, const RayTracer& tracer, const Streams& streams)
{
    NumberInput in(streams.in, wish.in);
    Answers answers(wish, tracer, streams.out);
    const RaySettings settings = ray_settings(wish.settings);
    bool more = true;
    while (more) {
        std::vector<InputRay> rays;
        std::vector<RayRequest> requests;
        while (rays.size() < rays_together) {
            auto ray = read_ray(in, wish);
            more = ray.has_value();
            if (!more)
                break;
            const bool flush = ray->bogus;
            if (!flush)
                requests.push_back(ray->request);
            rays.push_back(std::move(*ray));
            if (flush)
                break;
        }
        const std::vector<RayAnswer> found = tracer.trace(requests, settings);
        std::size_t next = 0;
        for (const InputRay& ray : rays)
            answers.write(ray, ray.bogus ? RayAnswer{} : found[next++]);
        streams.out.flush();
    }
}

} // namespace

/// rtrace: rays on standard input, what they see on standard output.
int rtrace(const std::vector<std::string>& words, const Streams& streams)
{
    if (words.size() == 2 && words[1] == "-defaults") {
        streams.out << trace_defaults();
        return 0;
    }
    const Wish wish = wish_of(words);
    std::unique_ptr<std::ofstream> log;
    if (!wish.log.empty())
        log = std::make_unique<std::ofstream>(wish.log, std::ios::app);
    std::ostream& err = log ? *log : streams.err;
    LoadedScene loaded = load_scene(wish.octree, streams);
    if (wish.settings.warnings)
        write_warnings(words[0], loaded.report, err);
    write_header(words, loaded, wish, streams.out);
    const RayTracer tracer(std::move(loaded.scene), preparation_for(wish.settings));
    trace_all(wish, tracer, streams);
    return 0;
}

} // namespace lightwell::commands
