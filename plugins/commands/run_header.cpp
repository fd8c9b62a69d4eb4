#include "plugins/commands/run_header.h"

#include "plugins/commands/scene_files.h"

#include <ctime>

namespace lightwell::commands {
namespace {

std::string time_text(const char* form, const std::tm& time)
{
    char text[64];
    return {text, std::strftime(text, sizeof text, form, &time)};
}

} // namespace

std::string run_history(const std::vector<std::string>& history, const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& line : history)
        text += line + '\n';
    const std::time_t now = std::time(nullptr);
    std::tm local{}, universal{};
    localtime_r(&now, &local);
    gmtime_r(&now, &universal);
    return text + command_line_of(words) + "\nSOFTWARE= Lightwell " + LIGHTWELL_VERSION +
           "\nCAPDATE= " + time_text("%Y:%m:%d %H:%M:%S", local) +
           "\nGMT= " + time_text("%Y:%m:%d %H:%M:%S", universal) + '\n';
}

std::string run_header(const std::vector<std::string>& history, const std::vector<std::string>& words)
{
    return "#?RADIANCE\n" + run_history(history, words);
}

std::string trace_defaults()
{
    return R"(-w+				# warning messages on
-n 0 				# number of threads, 0: all processors
-x 0        			# x resolution of a picture
-y 0        			# y resolution of a picture
-ld-				# limit distance off
-h+				# output header
-faa				# format input/output = ascii/ascii
-ov        			# output value
-i-				# irradiance calculation off
-av 0.000000 0.000000 0.000000	# ambient value, with -ab 0
-ab 0        			# ambient bounces: 0 direct light, else all
-aa 0.100000			# ambient accuracy: 0 plain path tracing
-ad 1024     			# ambient divisions: accuracy 0.7 / sqrt
)";
}

std::string picture_defaults()
{
    return R"(-vtv				# view type perspective
-vp 0.000000 0.000000 0.000000	# view point
-vd 0.000000 1.000000 0.000000	# view direction
-vu 0.000000 0.000000 1.000000	# view up
-vh 45.000000			# view horizontal size
-vv 45.000000			# view vertical size
-vo 0.000000			# view fore clipping plane
-va 0.000000			# view aft clipping plane
-vs 0.000000			# view shift
-vl 0.000000			# view lift
-x  512      			# x resolution
-y  512      			# y resolution
-pa 1.000000			# pixel aspect ratio
-pd 0.000000			# pixel depth-of-field
-t  0        			# time between reports
-w+				# warning messages on
-i-				# irradiance calculation off
-av 0.000000 0.000000 0.000000	# ambient value, with -ab 0
-ab 0        			# ambient bounces: 0 direct light, else all
-aa 0.200000			# ambient accuracy: 0 plain path tracing
-ad 512      			# ambient divisions: accuracy 0.7 / sqrt
)";
}

} // namespace lightwell::commands
