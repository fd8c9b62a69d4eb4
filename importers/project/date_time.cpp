#include "importers/project/date_time.h"

#include "engine/base/text.h"
#include "importers/project/time_zone.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Takes exactly `digits` digits from the front.
std::optional<int> take_number(std::string_view& text, std::size_t digits)
{
    if (text.size() < digits)
        return std::nullopt;
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i) {
        if (text[i] < '0' || text[i] > '9')
            return std::nullopt;
        value = 10 * value + (text[i] - '0');
    }
    text.remove_prefix(digits);
    return value;
}

bool take(std::string_view& text, char c)
{
    if (text.empty() || text[0] != c)
        return false;
    text.remove_prefix(1);
    return true;
}

int days_in_month(int year, int month)
{
    constexpr int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return month == 2 && leap ? 29 : days[month - 1];
}

bool take_date(std::string_view& text, DateTime& result)
{
    const auto year = take_number(text, 4);
    const bool first = take(text, '-');
    const auto month = take_number(text, 2);
    const bool second = take(text, '-');
    const auto day = take_number(text, 2);
    if (!year || !first || !month || !second || !day || *month < 1 || *month > 12 || *day < 1 ||
        *day > days_in_month(*year, *month))
        return false;
    result.year = *year;
    result.month = *month;
    result.day = *day;
    return true;
}

bool take_time(std::string_view& text, DateTime& result)
{
    const auto hour = take_number(text, 2);
    const bool colon = take(text, ':');
    const auto minute = take_number(text, 2);
    if (!hour || !colon || !minute || *hour > 23 || *minute > 59)
        return false;
    double seconds = 0;
    if (take(text, ':')) {
        const std::size_t end = std::min(text.find_first_of("+-Zz["), text.size());
        const auto value = parse_double(text.substr(0, end));
        if (!value || !(*value >= 0 && *value < 60))
            return false;
        seconds = *value;
        text.remove_prefix(end);
    }
    result.hour = *hour + *minute / 60.0 + seconds / 3600;
    return true;
}

bool take_offset(std::string_view& text, DateTime& result)
{
    if (text.empty())
        return true;
    if (take(text, 'Z') || take(text, 'z')) {
        result.utc_offset_h = 0;
        return text.empty();
    }
    if (take(text, '[')) {
        if (text.empty() || text.back() != ']')
            return false;
        result.utc_offset_h = utc_offset_in_zone_h(std::string(text.substr(0, text.size() - 1)), result);
        return result.utc_offset_h.has_value();
    }
    const bool negative = text[0] == '-';
    if (!take(text, '+') && !take(text, '-'))
        return false;
    const auto hours = take_number(text, 2);
    take(text, ':');
    const auto minutes = text.empty() ? std::optional<int>(0) : take_number(text, 2);
    if (!hours || !minutes || *hours > 14 || *minutes > 59)
        return false;
    result.utc_offset_h = (negative ? -1 : 1) * (*hours + *minutes / 60.0);
    return text.empty();
}

} // namespace

std::optional<DateTime> parse_date_time(std::string_view text)
{
    DateTime result;
    text = trimmed(text);
    if (!take_date(text, result) || !(take(text, 'T') || take(text, 't') || take(text, ' ')) ||
        !take_time(text, result) || !take_offset(text, result))
        return std::nullopt;
    return result;
}

} // namespace lightwell
