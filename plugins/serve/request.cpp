#include "plugins/serve/request.h"

#include "engine/base/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace lightwell::serve {
namespace {

using Json = nlohmann::json;
using Task = Request::Task;

constexpr int most_pixels_a_side = 1 << 15;
constexpr int most_samples = 1 << 20;
constexpr int most_threads = 4096;
constexpr double longest_s = 1e6;
constexpr double largest_spacing_m = 1e6;
/// Beyond this a double no longer holds every whole number, and hosts count in doubles.
constexpr std::int64_t largest_id = std::int64_t{1} << 53;

constexpr std::pair<Task, const char*> task_names[] = {{Task::load, "load"},
                                                       {Task::edit, "edit"},
                                                       {Task::plan, "plan"},
                                                       {Task::render, "render"},
                                                       {Task::illuminance, "illuminance"},
                                                       {Task::surfaces, "surfaces"},
                                                       {Task::cancel, "cancel"},
                                                       {Task::quit, "quit"}};

struct Words {
    Task task;
    std::vector<std::string_view> must, may;
};
const Words words_of_tasks[] = {
    {Task::load, {"scene"}, {"map", "threads"}},
    {Task::edit, {}, {}},
    {Task::plan, {}, {"view", "grid", "size", "accuracy", "samples"}},
    {Task::render,
     {"view", "file"},
     {"size", "region", "accuracy", "seconds", "samples", "seed", "threads", "layer", "progressive", "ambient_file"}},
    {Task::illuminance, {"grid", "file"}, {"accuracy", "seconds", "samples", "seed", "threads", "ambient_file"}},
    {Task::surfaces,
     {"file"},
     {"parts", "spacing", "accuracy", "seconds", "samples", "seed", "threads", "ambient_file"}},
    {Task::cancel, {"target"}, {}},
    {Task::quit, {}, {}},
};

constexpr const char* one_object = R"(one object a line, for example {"id":1,"do":"quit"})";

class Parser {
public:
    Request parse(std::string_view line)
    {
        try {
            json_ = Json::parse(line);
        } catch (const Json::exception&) {
            refuse("the line is no JSON", one_object);
        }
        if (!json_.is_object())
            refuse("the line is no JSON object", one_object);
        read_id();
        read_task();
        check_words();
        read_rest();
        return request_;
    }

private:
    [[noreturn]] void refuse(const std::string& text, const std::string& way_out = {}) const
    {
        throw BadRequest{id_, text, way_out};
    }

    void read_id()
    {
        const auto found = json_.find("id");
        if (found == json_.end() || !found->is_number_integer() || (found->is_number_unsigned() && too_large(*found)) ||
            std::abs(found->get<std::int64_t>()) > largest_id)
            refuse("\"id\" is missing or no whole number", "give every request a number of its own");
        id_ = request_.id = found->get<std::int64_t>();
    }
    static bool too_large(const Json& number)
    {
        return number.get<std::uint64_t>() > static_cast<std::uint64_t>(largest_id);
    }

    void read_task()
    {
        const std::string name = text("do");
        const auto found =
            std::find_if(std::begin(task_names), std::end(task_names), [&](const auto& t) { return name == t.second; });
        if (found == std::end(task_names))
            refuse("\"do\" is \"" + name.substr(0, 40) + "\", which is not known",
                   "use load, edit, plan, render, illuminance, surfaces, cancel or quit");
        request_.task = found->first;
    }

    void check_words() const
    {
        const Words& words = *std::find_if(std::begin(words_of_tasks), std::end(words_of_tasks),
                                           [&](const Words& w) { return w.task == request_.task; });
        const auto has = [](const std::vector<std::string_view>& list, std::string_view word) {
            return std::find(list.begin(), list.end(), word) != list.end();
        };
        for (const auto& [word, value] : json_.items())
            if (word != "id" && word != "do" && !has(words.must, word) && !has(words.may, word))
                refuse("\"" + word.substr(0, 40) + "\" is no word of " + name_of(request_.task));
        for (const std::string_view word : words.must)
            if (!json_.contains(word))
                refuse(std::string(name_of(request_.task)) + " needs \"" + std::string(word) + "\"");
    }

    std::string text(const char* word) const
    {
        const auto found = json_.find(word);
        if (found == json_.end() || !found->is_string())
            refuse("\"" + std::string(word) + "\" is missing or no text");
        return found->get<std::string>();
    }
    void text(const char* word, std::string& to) const
    {
        if (!json_.contains(word))
            return;
        to = text(word);
        if (to.empty() || to.find('\0') != std::string::npos)
            refuse("\"" + std::string(word) + "\" is empty or holds a zero byte");
    }

    double number(const Json& value, const std::string& word, double least, double most) const
    {
        const double found = value.is_number() ? value.get<double>() : std::nan("");
        if (!(found >= least && found <= most))
            refuse("\"" + word + "\" is " + value.dump().substr(0, 40) + ", expected a number from " + shortest(least) +
                   " to " + shortest(most));
        return found;
    }
    void number(const char* word, double& to, double least, double most) const
    {
        if (json_.contains(word))
            to = number(json_.at(word), word, least, most);
    }
    int whole(const Json& value, const std::string& word, double least, double most) const
    {
        const double found = number(value, word, least, most);
        if (found != std::floor(found))
            refuse("\"" + word + "\" is " + value.dump().substr(0, 40) + ", expected a whole number");
        return static_cast<int>(found);
    }
    void whole(const char* word, int& to, double least, double most) const
    {
        if (json_.contains(word))
            to = whole(json_.at(word), word, least, most);
    }

    std::vector<int> list(const char* word, std::size_t count, double least) const
    {
        const Json& value = json_.at(word);
        if (!value.is_array() || value.size() != count)
            refuse("\"" + std::string(word) + "\" is no list of " + std::to_string(count) + " numbers");
        std::vector<int> numbers;
        for (const Json& entry : value)
            numbers.push_back(whole(entry, word, least, most_pixels_a_side));
        return numbers;
    }

    void read_picture_words()
    {
        if (json_.contains("size")) {
            const std::vector<int> size = list("size", 2, 1);
            request_.width = size[0];
            request_.height = size[1];
        }
        if (json_.contains("region")) {
            const std::vector<int> r = list("region", 4, 0);
            if (r[0] >= r[2] || r[1] >= r[3])
                refuse("\"region\" is empty", "give x0, y0, x1, y1 with x0 < x1 and y0 < y1, row 0 at the top");
            request_.region = {r[0], r[1], r[2] - r[0], r[3] - r[1]};
        }
        if (json_.contains("layer"))
            request_.layer = text("layer");
        if (json_.contains("progressive")) {
            if (!json_.at("progressive").is_boolean())
                refuse("\"progressive\" is neither true nor false");
            request_.progressive = json_.at("progressive").get<bool>();
        }
    }

    void read_effort()
    {
        constexpr double least_accuracy = 1e-4, most_accuracy = 0.99;
        number("accuracy", request_.accuracy, least_accuracy, most_accuracy);
        constexpr double least_s = 0.01;
        number("seconds", request_.seconds, least_s, longest_s);
        whole("samples", request_.samples, 1, most_samples);
        if (int(json_.contains("accuracy")) + int(json_.contains("seconds")) + int(json_.contains("samples")) > 1)
            refuse("more than one of \"accuracy\", \"seconds\" and \"samples\"", "give one");
        whole("threads", request_.threads, 0, most_threads);
        if (json_.contains("seed")) {
            const Json& seed = json_.at("seed");
            if (!seed.is_number_unsigned())
                refuse("\"seed\" is " + seed.dump().substr(0, 40) + ", expected a whole number, at least 0");
            request_.seed = seed.get<std::uint64_t>();
        }
    }

    void read_parts()
    {
        if (!json_.contains("parts"))
            return;
        const Json& parts = json_.at("parts");
        if (!parts.is_array() || parts.empty() ||
            !std::all_of(parts.begin(), parts.end(), [](const Json& part) { return part.is_string(); }))
            refuse("\"parts\" is no list of names", "leave it out for all objects");
        request_.parts = parts.get<std::vector<std::string>>();
    }

    void read_rest()
    {
        const std::pair<const char*, std::string*> texts[] = {
            {"scene", &request_.scene}, {"map", &request_.map},   {"view", &request_.view},
            {"grid", &request_.grid},   {"file", &request_.file}, {"ambient_file", &request_.ambient_file}};
        for (const auto& [word, to] : texts)
            text(word, *to);
        read_picture_words();
        read_effort();
        constexpr double least_spacing_m = 1e-6;
        number("spacing", request_.spacing_m, least_spacing_m, largest_spacing_m);
        read_parts();
        if (json_.contains("target")) {
            if (!json_.at("target").is_number_integer())
                refuse("\"target\" is no whole number", "give the id of the request to be stopped");
            request_.target = json_.at("target").get<std::int64_t>();
        }
        if (request_.task == Task::plan && request_.view.empty() == request_.grid.empty())
            refuse("plan needs either \"view\" or \"grid\"");
    }

    Json json_;
    std::optional<std::int64_t> id_;
    Request request_;
};

} // namespace

Request parse_request(std::string_view line)
{
    return Parser().parse(line);
}

const char* name_of(Task task) noexcept
{
    for (const auto& [known, name] : task_names)
        if (known == task)
            return name;
    return "";
}

} // namespace lightwell::serve
