#include "engine/scene/view.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <vector>

namespace lightwell {
namespace {

/// The angle of the part `share` of a picture's side, for the projection of that side.
double cropped_angle(View::Kind kind, bool across, double full, double share)
{
    const double half = 0.5 * full * radians_per_degree, whole = 2 / radians_per_degree;
    switch (kind) {
    case View::Kind::perspective:
        return whole * std::atan(share * std::tan(half));
    case View::Kind::cylindrical:
        return across ? share * full : whole * std::atan(share * std::tan(half));
    case View::Kind::hemispherical:
        return whole * std::asin(share * std::sin(half));
    case View::Kind::planisphere:
        return whole * 2 * std::atan(share * std::tan(0.5 * half));
    case View::Kind::parallel:
    case View::Kind::angular:
        return share * full;
    }
    return full;
}

} // namespace

View cropped(const View& view, double x0, double y0, double x1, double y1)
{
    View part = view;
    const double width = x1 - x0, height = y1 - y0;
    part.horizontal = cropped_angle(view.kind, true, view.horizontal, width);
    part.vertical = cropped_angle(view.kind, false, view.vertical, height);
    part.shift = (0.5 * (x0 + x1) - 0.5 + view.shift) / width;
    part.lift = (0.5 * (y0 + y1) - 0.5 + view.lift) / height;
    return part;
}

namespace {

class ViewWords {
public:
    ViewWords(const std::string& text, std::string place) : words_(split(text, " \t\r\n")), place_(std::move(place)) {}
    bool done() const { return next_ == words_.size(); }
    std::string_view word() { return words_[next_++]; }
    double number(std::string_view after)
    {
        const auto value = done() ? std::nullopt : parse_double(words_[next_]);
        if (!value || !std::isfinite(*value))
            throw InputError{place_, fmt::format("{} is followed by \"{}\", expected a finite number", after,
                                                 done() ? "nothing" : words_[next_])};
        ++next_;
        return *value;
    }
    Vec3 vector(std::string_view after)
    {
        const double x = number(after), y = number(after);
        return {x, y, number(after)};
    }

private:
    std::vector<std::string_view> words_;
    std::string place_;
    std::size_t next_ = 0;
};

View::Kind view_kind(std::string_view word, const std::string& place)
{
    for (const View::Kind kind : {View::Kind::perspective, View::Kind::parallel, View::Kind::cylindrical,
                                  View::Kind::hemispherical, View::Kind::angular, View::Kind::planisphere})
        if (word.size() == 4 && word[3] == static_cast<char>(kind))
            return kind;
    throw InputError{place, fmt::format("view type \"{}\" is not known", word),
                     "use -vtv perspective, -vtl parallel, -vtc cylindrical, or a fisheye: -vth hemispherical, "
                     "-vta angular, -vts planisphere"};
}

} // namespace

View parse_view(const std::string& text, const std::string& place)
{
    View view;
    ViewWords words(text, place);
    while (!words.done()) {
        std::string_view word = words.word();
        if (word.starts_with("VIEW="))
            word.remove_prefix(5);
        if (word.empty() || word == "rvu" || word == "rview" || word == "rpict")
            continue;
        if (word.starts_with("-vt"))
            view.kind = view_kind(word, place);
        else if (word == "-vp")
            view.position = words.vector(word);
        else if (word == "-vd")
            view.direction = words.vector(word);
        else if (word == "-vu")
            view.up = words.vector(word);
        else if (word == "-vh")
            view.horizontal = words.number(word);
        else if (word == "-vv")
            view.vertical = words.number(word);
        else if (word == "-vs")
            view.shift = words.number(word);
        else if (word == "-vl")
            view.lift = words.number(word);
        else if (word == "-vo")
            view.fore_m = words.number(word);
        else if (word == "-va")
            view.aft_m = words.number(word);
        else if (word == "-pd")
            view.lens_m = words.number(word);
        else if (word == "-pf")
            view.focus_m = words.number(word);
        else
            throw InputError{place, fmt::format("\"{}\" is not a word of a view", word),
                             "use -vt -vp -vd -vu -vh -vv -vs -vl -vo -va -pd -pf"};
    }
    return view;
}

std::string to_text(const View& view)
{
    const auto triple = [](const Vec3& v) { return shortest(v.x) + ' ' + shortest(v.y) + ' ' + shortest(v.z); };
    std::string text =
        fmt::format("-vt{} -vp {} -vd {} -vu {} -vh {} -vv {} -vs {} -vl {} -vo {} -va {}",
                    static_cast<char>(view.kind), triple(view.position), triple(view.direction), triple(view.up),
                    shortest(view.horizontal), shortest(view.vertical), shortest(view.shift), shortest(view.lift),
                    shortest(view.fore_m), shortest(view.aft_m));
    if (view.lens_m > 0)
        text += " -pd " + shortest(view.lens_m) + " -pf " + shortest(view.focus_m);
    return text;
}

} // namespace lightwell
