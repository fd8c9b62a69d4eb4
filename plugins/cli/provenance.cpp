#include "plugins/cli/provenance.h"

#include "engine/base/files.h"
#include "engine/base/text.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>
#include <unistd.h>

namespace lightwell {
namespace {

/// The command line of this process: set once by main, read by every record.
std::string& command_of_process()
{
    static std::string command;
    return command;
}

/// A word as a shell would want it.
std::string quoted(const std::string& word)
{
    if (!word.empty() && word.find_first_of(" \t\n\"'\\$`*?[]{}()<>|&;#!~") == std::string::npos)
        return word;
    std::string text(1, '\'');
    for (const char c : word) {
        if (c == '\'')
            text += "'\\''";
        else
            text += c;
    }
    text += '\'';
    return text;
}

std::string host_name()
{
    char name[256] = "";
    return gethostname(name, sizeof name - 1) == 0 ? name : "";
}

std::string utc_now()
{
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

} // namespace

std::string program_version()
{
    return "lightwell " LIGHTWELL_VERSION;
}

void remember_command(const std::vector<std::string>& arguments)
{
    std::string command = "lightwell";
    for (std::size_t i = 1; i < arguments.size(); ++i)
        command.append(" ").append(quoted(to_utf8(arguments[i])));
    command_of_process() = command;
}

std::filesystem::path run_record_name(const std::filesystem::path& result)
{
    return std::filesystem::path(result).replace_extension(".run.json");
}

void write_run_record(const std::filesystem::path& result, const RunRecord& record)
{
    nlohmann::ordered_json json;
    json["program"] = program_version();
    json["command"] = command_of_process();
    json["result"] = to_utf8(result.filename().string());
    json["finished"] = utc_now();
    json["host"] = host_name();
    json["processors"] = std::thread::hardware_concurrency();
    json["threads"] = record.threads == 0 ? static_cast<int>(std::thread::hardware_concurrency()) : record.threads;
    json["seconds"] = record.seconds;
    json["cpu_seconds"] = record.cpu_seconds;
    json["samples"] = record.samples;
    json["built"] = {{"deep_sites", record.work.deep_sites},
                     {"bright_discs", record.work.bright_discs},
                     {"secondary_sources", record.work.secondary_sources},
                     {"ambient_records", record.work.ambient_records},
                     {"sites_from_file", record.work.sites_kept},
                     {"records_from_file", record.work.records_kept}};
    json["rays"] = {{"ambient", record.work.ambient_rays.total()},
                    {"fixed", record.work.fixed_rays.total()},
                    {"values", record.work.value_rays.total()},
                    {"all", record.work.rays().total()},
                    {"shadow", record.work.rays().shadow}};
    json["wanted_accuracy"] = record.wanted_accuracy;
    if (record.wanted_time_s > 0)
        json["wanted_time_s"] = record.wanted_time_s;
    json["replay"] = record.replay;
    json["median_relative_error"] = record.median_relative_error;
    if (record.bias.points > 0)
        json["bias"] = {{"mean", record.bias.mean},
                        {"standard_error", record.bias.standard_error},
                        {"spread", record.bias.spread},
                        {"points", record.bias.points}};
    if (record.predicted)
        json["predicted"] = {{"cpu_seconds", record.predicted->cpu_seconds},
                             {"rays", std::round(record.predicted->rays)},
                             {"median_relative_error", record.predicted->error},
                             {"samples", record.predicted->samples},
                             {"pilot_cpu_seconds", record.predicted->pilot.seconds}};
    for (const auto& [name, value] : record.more)
        json["settings"][name] = to_utf8(value);
    json["notes"] = nlohmann::ordered_json::array();
    for (const Note& note : record.report.notes())
        json["notes"].push_back({{"finding", to_string(note.finding)},
                                 {"place", to_utf8(note.place)},
                                 {"text", to_utf8(note.text)},
                                 {"count", note.count}});
    write_text_atomically(run_record_name(result), json.dump(2) + "\n");
}

} // namespace lightwell
