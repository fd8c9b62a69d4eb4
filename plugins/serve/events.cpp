#include "plugins/serve/events.h"

#include "engine/base/text.h"
#include "plugins/cli/provenance.h"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <unistd.h>

namespace lightwell::serve {
namespace {

using Json = nlohmann::ordered_json;

constexpr int protocol_version = 1;
constexpr std::chrono::milliseconds between_reports{100};

/// Where the stages of a run lie within it, roughly, by the beginning of their names.
struct StageShare {
    const char* beginning;
    double from, to;
};
constexpr StageShare stage_shares[] = {
    {"ambient light", 0, 0.35}, {"pilot run", 0.35, 0.4}, {"view", 0.4, 0.97}, {"grid", 0.4, 0.97}, {"check", 0.97, 1}};

double within_run(const std::string& stage, double fraction)
{
    for (const StageShare& share : stage_shares)
        if (stage.starts_with(share.beginning))
            return share.from + (share.to - share.from) * fraction;
    return 0;
}

/// Texts of files may be in any encoding; JSON is UTF-8.
std::string text_of(const Json& json)
{
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// `room.rad:12: mesh "desk": what; way out` in its parts; what is none of them is the text.
void add_parts(Json& json, const std::string& sentence)
{
    std::string_view text = sentence;
    const std::size_t colon = text.find(':'), after = text.find(": ", colon + 1);
    if (colon != text.npos && after != text.npos)
        if (const auto line = parse_integer(text.substr(colon + 1, after - colon - 1))) {
            json["file"] = std::string(text.substr(0, colon));
            json["line"] = *line;
            text.remove_prefix(after + 2);
        }
    const std::size_t blank = text.find(' '), end = text.find("\": ");
    if (blank != text.npos && end != text.npos && text.find('"') == blank + 1 && text.find(':') > blank) {
        json[text.starts_with("layer ") ? "layer" : "object"] = std::string(text.substr(blank + 2, end - blank - 2));
        text.remove_prefix(end + 3);
    }
    if (const std::size_t at = text.rfind("; "); at != text.npos) {
        json["way_out"] = std::string(text.substr(at + 2));
        text = text.substr(0, at);
    }
    json["text"] = std::string(text);
}

} // namespace

void Events::line(std::optional<std::int64_t> id, const std::string& text)
{
    const std::lock_guard lock(mutex_);
    if (!id || id != silent_)
        write(text + '\n');
}

void Events::write(const std::string& whole)
{
    for (std::size_t done = 0; done < whole.size() && !broken_;) {
        const ssize_t written = ::write(descriptor_, whole.data() + done, whole.size() - done);
        if (written >= 0)
            done += static_cast<std::size_t>(written);
        else if (errno != EINTR)
            broken_ = true;
    }
}

void Events::hello()
{
    const std::string version = program_version();
    line(std::nullopt, text_of({{"event", "hello"},
                                {"protocol", protocol_version},
                                {"engine", version.substr(version.find(' ') + 1)},
                                {"pid", getpid()}}));
}

void Events::progress(std::int64_t id, double fraction, const std::string& phase, std::optional<double> seconds_left)
{
    Json json = {{"event", "progress"}, {"id", id}, {"fraction", fraction}, {"phase", phase}};
    if (seconds_left)
        json["seconds_left"] = *seconds_left;
    line(id, text_of(json));
}

void Events::partial(std::int64_t id, const std::string& file, int samples, double error)
{
    line(id, text_of({{"event", "partial"}, {"id", id}, {"file", file}, {"samples", samples}, {"error", error}}));
}

void Events::result(std::int64_t id, const std::string& kind, const std::string& more)
{
    std::string text = text_of({{"event", "result"}, {"id", id}, {"kind", kind}});
    text.pop_back();
    line(id, text + (more.empty() ? "" : ",") + more + "}");
}

void Events::cancelled(std::int64_t id)
{
    line(id, text_of({{"event", "cancelled"}, {"id", id}}));
}

void Events::cancelled_for_good(std::int64_t id)
{
    const std::lock_guard lock(mutex_);
    write(text_of({{"event", "cancelled"}, {"id", id}}) + '\n');
    silent_ = id;
}

void Events::error(const BadRequest& bad)
{
    Json json = {{"event", "error"}, {"id", nullptr}, {"text", bad.text}};
    if (bad.id)
        json["id"] = *bad.id;
    if (!bad.way_out.empty())
        json["way_out"] = bad.way_out;
    line(bad.id, text_of(json));
}

void Events::error(std::int64_t id, const std::string& sentence)
{
    Json json = {{"event", "error"}, {"id", id}, {"text", sentence}};
    add_parts(json, sentence);
    line(id, text_of(json));
}

Progress Told::part(double begin, double end)
{
    return {[this, begin, end](const std::string& stage, double fraction) { tell(stage, fraction, begin, end); },
            [this] { return stop_.load(std::memory_order_relaxed); }};
}

void Told::tell(const std::string& stage, double fraction, double begin, double end)
{
    fraction_ = std::max(fraction_, begin + (end - begin) * within_run(stage, fraction));
    const std::optional<double> left = time_.left_s(stage, fraction);
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < between_reports)
        return;
    last_ = now;
    events_.progress(id_, fraction_, stage, left);
}

} // namespace lightwell::serve
