#include "plugins/validation/validation.h"

#include "engine/base/errors.h"
#include "engine/base/nearest.h"
#include "engine/base/threads.h"
#include "plugins/validation/measure.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <mutex>

namespace lightwell {
namespace {

/// Of the deliberate error; glass and mirrors become darker, since a clear one cannot become clearer.
constexpr double perturbation = 1.02;

constexpr std::pair<Technique, const char*> names[] = {{Technique::direct, "direct"},
                                                       {Technique::sky, "sky"},
                                                       {Technique::glass, "glass"},
                                                       {Technique::interreflection, "interreflection"},
                                                       {Technique::specular, "specular"}};

std::vector<Case> all_cases()
{
    std::vector<Case> all;
    for (auto list : {detection_cases, electric_cases, daylight_cases, sky_model_cases, radiosity_cases, lamp_cases,
                      form_factor_cases, sun_cases, sky_cases, glass_cases, dielectric_cases, furnace_cases,
                      mirror_cases, interreflection_cases, leak_cases}) {
        std::vector<Case> some = list();
        std::move(some.begin(), some.end(), std::back_inserter(all));
    }
    return all;
}

Perturbation perturbation_of(const std::optional<Technique>& technique)
{
    Perturbation p;
    if (technique == Technique::direct)
        p.direct = perturbation;
    else if (technique == Technique::sky)
        p.sky = perturbation;
    else if (technique == Technique::glass)
        p.glass = 1 / perturbation;
    else if (technique == Technique::interreflection)
        p.interreflection = perturbation;
    else if (technique == Technique::specular)
        p.specular = 1 / perturbation;
    return p;
}

/// One scene of one case, run independently of the others.
struct Task {
    const Case* from;
    const Setup* setup; ///< null: the case counts, or its setups come later
    std::vector<ValidationRow> rows;
};

void run_setup(const Setup& setup, const ValidationOptions& options, const Progress& progress,
               std::vector<ValidationRow>& rows)
{
    std::vector<const Check*> checks;
    for (const Check& check : setup.checks)
        if ((options.full || !check.only_full) && (check.detection || !options.only_detection))
            checks.push_back(&check);
    if (checks.empty())
        return;
    const Simulation simulation(setup.scene(perturbation_of(options.perturb)), setup.preparation);
    for (const Check* check : checks) {
        if (progress.stop())
            throw Cancelled{};
        rows.push_back(run_check(simulation, *check, options));
    }
}

std::vector<ValidationRow> run(const Task& task, const ValidationOptions& options, const Progress& progress)
{
    std::vector<ValidationRow> rows;
    if (task.setup != nullptr) {
        run_setup(*task.setup, options, progress, rows);
    } else if (task.from->later) {
        for (const Setup& setup : task.from->later().setups)
            run_setup(setup, options, progress, rows);
    } else {
        rows = {task.from->count(options)};
    }
    return rows;
}

/// A case that fails to run is a row that says why.
std::vector<ValidationRow> run_safely(const Task& task, const ValidationOptions& options, const Progress& progress)
{
    std::vector<ValidationRow> rows;
    try {
        rows = run(task, options, progress);
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception& error) {
        ValidationRow row;
        row.quantity = "does not run";
        row.reason = error.what();
        rows = {row};
    }
    for (ValidationRow& row : rows) {
        row.case_id = task.from->id;
        row.techniques = task.from->techniques;
    }
    return rows;
}

std::vector<std::string> case_names(const std::vector<Case>& cases)
{
    std::vector<std::string> found;
    for (const Case& c : cases)
        if (found.empty() || found.back() != c.id)
            found.push_back(c.id);
    return found;
}

} // namespace

Check luminance_check(std::string quantity, double expected, double relative, const Point& from,
                      const Direction& direction)
{
    constexpr double narrow_deg = 1e-6;
    View view;
    view.position = from;
    view.direction = direction;
    view.up = std::fabs(direction.z) > std::fabs(direction.y) ? Direction{0, 1, 0} : Direction{0, 0, 1};
    view.horizontal = view.vertical = narrow_deg;
    return {std::move(quantity), expected, relative * expected, {}, view, false, "cd/m2"};
}

Check detecting(Check check)
{
    check.detection = true;
    return check;
}

std::string numbered(const std::string& name, double number)
{
    return fmt::format("{}{}", name, number);
}

std::vector<ValidationRow> validate_engine(const ValidationOptions& options, const Progress& progress)
{
    const std::vector<Case> cases = all_cases();
    std::vector<Task> tasks;
    for (const Case& c : cases) {
        if (c.id.find(options.only) == std::string::npos)
            continue;
        if (c.only_full && !options.full)
            continue;
        for (const Setup& setup : c.setups)
            tasks.push_back({&c, &setup, {}});
        if ((c.count || (c.later && (options.full || !c.only_full))) && !options.only_detection)
            tasks.push_back({&c, nullptr, {}});
    }
    if (tasks.empty())
        throw InputError{"--case " + options.only, "is in the name of no case",
                         nearest_hint(options.only, case_names(cases))};
    std::size_t done = 0;
    std::mutex telling;
    // Backwards: the last cases take longest.
    parallel_for(tasks.size(), options.threads, [&](std::size_t i) {
        Task& task = tasks[tasks.size() - 1 - i];
        task.rows = run_safely(task, options, progress);
        const std::lock_guard lock(telling);
        progress.tell("validation", static_cast<double>(++done) / static_cast<double>(tasks.size()));
    });
    std::vector<ValidationRow> rows;
    for (Task& task : tasks)
        std::move(task.rows.begin(), task.rows.end(), std::back_inserter(rows));
    return rows;
}

bool all_passed(const std::vector<ValidationRow>& rows)
{
    return std::all_of(rows.begin(), rows.end(), [](const ValidationRow& row) { return row.passed; });
}

std::vector<std::string> technique_names(unsigned techniques)
{
    std::vector<std::string> found;
    for (const auto& [technique, name] : names)
        if ((techniques & static_cast<unsigned>(technique)) != 0)
            found.emplace_back(name);
    return found;
}

Technique parse_perturbation(const std::string& name)
{
    for (const auto& [technique, word] : names)
        if (name == word)
            return technique;
    if (name == "ambient")
        return Technique::interreflection;
    throw InputError{"--perturb " + name, "is not a technique",
                     "use direct, specular, ambient (or interreflection), sky or glass"};
}

std::vector<ReferenceValue> reference_values()
{
    std::vector<ReferenceValue> values;
    for (const Case& listed : all_cases()) {
        const Case c = listed.later ? listed.later() : listed;
        for (const auto& [key, value] : c.references)
            values.push_back({c.id, key, value});
        if (c.references.empty())
            for (const Setup& setup : c.setups)
                for (const Check& check : setup.checks) {
                    if (check.each.empty())
                        values.push_back({c.id, check.quantity, check.expected});
                    for (std::size_t i = 0; i < check.each.size(); ++i)
                        values.push_back({c.id, check.names[i], check.each[i]});
                }
    }
    return values;
}

std::string validation_table(const std::vector<ValidationRow>& rows)
{
    std::size_t id_width = 4, quantity_width = 8, passed = 0;
    for (const ValidationRow& row : rows) {
        id_width = std::max(id_width, row.case_id.size());
        quantity_width = std::max(quantity_width, row.quantity.size());
    }
    std::string text =
        fmt::format("{:<{}}  {:<{}}  {:>13}  {:>13}  {:>10}  {:>9}  {:>9}  verdict\n", "case", id_width, "quantity",
                    quantity_width, "expected", "found", "+- 95 %", "deviation", "tolerance");
    const auto relative = [](double part, double whole) {
        return whole == 0 ? fmt::format("{:.2g}", part) : fmt::format("{:.3f} %", 100 * part / std::fabs(whole));
    };
    for (const ValidationRow& row : rows) {
        text += fmt::format("{:<{}}  {:<{}}  {:>13.7g}  {:>13.7g}  {:>10.3g}  {:>9}  {:>9}  {}\n", row.case_id,
                            id_width, row.quantity, quantity_width, row.expected, row.found, row.half_width_95,
                            relative(row.deviation(), row.expected), relative(row.tolerance, row.expected),
                            row.passed ? "passed" : "FAILED: " + row.reason);
        passed += row.passed ? 1 : 0;
    }
    return text + fmt::format("{} of {} rows passed\n", passed, rows.size());
}

} // namespace lightwell
