#include "importers/project/time_zone.h"

#include "importers/project/date_time.h"

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <mutex>

namespace lightwell {
namespace {

/// A file of the database, which begins with `TZif`; names that lead out of its folder are none.
bool is_zone(const std::string& name)
{
    if (name.empty() || name.front() == '/' || name.find("..") != std::string::npos)
        return false;
    const char* folder = std::getenv("TZDIR");
    std::ifstream file(std::filesystem::path(folder != nullptr ? folder : "/usr/share/zoneinfo") / name,
                       std::ios::binary);
    char mark[4] = "";
    return file.read(mark, sizeof mark) && std::string(mark, sizeof mark) == "TZif";
}

/// The process' own zone, put back at the end. The C library has one zone for all: calls follow one another.
class OtherZone {
public:
    explicit OtherZone(const std::string& name) : lock_(one_at_a_time())
    {
        if (const char* before = std::getenv("TZ"))
            before_ = before;
        ::setenv("TZ", (":" + name).c_str(), 1);
        ::tzset();
    }
    ~OtherZone()
    {
        if (before_)
            ::setenv("TZ", before_->c_str(), 1);
        else
            ::unsetenv("TZ");
        ::tzset();
    }
    OtherZone(const OtherZone&) = delete;
    OtherZone& operator=(const OtherZone&) = delete;

private:
    static std::mutex& one_at_a_time()
    {
        static std::mutex mutex;
        return mutex;
    }
    std::lock_guard<std::mutex> lock_;
    std::optional<std::string> before_;
};

} // namespace

std::optional<double> utc_offset_in_zone_h(const std::string& zone, const DateTime& local)
{
    if (!is_zone(zone))
        return std::nullopt;
    const OtherZone in_zone(zone);
    const int minutes = static_cast<int>(std::floor(local.hour * 60));
    for (const int summer_time : {1, 0}) {
        std::tm wanted{};
        wanted.tm_year = local.year - 1900;
        wanted.tm_mon = local.month - 1;
        wanted.tm_mday = local.day;
        wanted.tm_hour = minutes / 60;
        wanted.tm_min = minutes % 60;
        wanted.tm_isdst = summer_time;
        std::tm found = wanted;
        ::mktime(&found);
        const bool same = found.tm_isdst == summer_time && found.tm_hour == wanted.tm_hour &&
                          found.tm_min == wanted.tm_min && found.tm_mday == wanted.tm_mday;
        if (same)
            return static_cast<double>(found.tm_gmtoff) / 3600;
    }
    return std::nullopt;
}

} // namespace lightwell
