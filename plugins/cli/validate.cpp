#include "plugins/insight/validation_report.h"

#include "engine/base/errors.h"
#include "plugins/cli/provenance.h"
#include "plugins/cli/subcommands.h"
#include "plugins/cli/terminal.h"
#include "plugins/validation/validation.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>

namespace lightwell {
namespace {

struct ValidateOptions {
    ValidationOptions validation;
    std::string perturb, html;
    bool json = false;
};

constexpr const char* examples = R"(Examples:
  lightwell validate                                 one or two minutes, tolerances of 1 %
  lightwell validate --full                          the tolerances of the cases, minutes
  lightwell validate --full --html report            also report/index.html, with plots
  lightwell validate --case cl_sky --json
Each row compares a value found by the engine with one recomputed from its formula. It passes when the deviation is at
most the tolerance and three standard errors, and the standard error at most a third of the tolerance.)";

void print_json(const std::vector<ValidationRow>& rows, const ValidateOptions& options, std::ostream& out)
{
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const ValidationRow& row : rows)
        list.push_back({{"case", row.case_id},
                        {"quantity", row.quantity},
                        {"unit", row.unit},
                        {"techniques", technique_names(row.techniques)},
                        {"detection", row.detection},
                        {"expected", row.expected},
                        {"found", row.found},
                        {"half_width_95", row.half_width_95},
                        {"deviation", row.deviation()},
                        {"tolerance", row.tolerance},
                        {"passed", row.passed},
                        {"reason", row.reason},
                        {"cpu_seconds", row.cpu_s}});
    nlohmann::ordered_json result{{"version", program_version()},
                                  {"full", options.validation.full},
                                  {"seed", options.validation.seed},
                                  {"passed", all_passed(rows)},
                                  {"rows", list}};
    if (!options.perturb.empty())
        result["perturbed"] = options.perturb;
    out << result.dump(2) << '\n';
}

void write_page(const std::filesystem::path& folder, const std::vector<ValidationRow>& rows,
                const ValidateOptions& options)
{
    const std::string what =
        std::string(options.validation.full ? "Full run" : "Quick look")
            .append(", seed ")
            .append(std::to_string(options.validation.seed))
            .append(", ")
            .append(program_version())
            .append(options.perturb.empty() ? "" : ", with a deliberate error in " + options.perturb);
    std::ofstream page(folder / "index.html", std::ios::binary);
    if (!(page << validation_html(rows, what)) || !page.flush())
        throw InputError{(folder / "index.html").string(), "cannot be written", "is the folder writable?"};
}

/// Before the minutes that the cases take.
void make_folder(const std::string& folder)
{
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed)
        throw InputError{folder, "cannot be made", failed.message()};
}

Status validate(ValidateOptions options, std::ostream& out)
{
    if (!options.html.empty())
        make_folder(options.html);
    if (!options.perturb.empty())
        options.validation.perturb = parse_perturbation(options.perturb);
    catch_interrupts();
    std::vector<ValidationRow> rows;
    {
        ProgressLine line("validate");
        rows = validate_engine(options.validation, line.progress());
    }
    if (!options.html.empty())
        write_page(options.html, rows, options);
    if (options.json)
        print_json(rows, options, out);
    else
        out << validation_table(rows);
    return all_passed(rows) ? Status::done : Status::no;
}

} // namespace

/// lightwell validate [--quick | --full] [--case TEXT] [--html DIR] [--json]: the engine against closed forms.
/// Status 1 when a row does not pass.
void add_validate(CLI::App& app, Status& status)
{
    auto options = std::make_shared<ValidateOptions>();
    CLI::App& command = *app.add_subcommand("validate", "the engine against closed forms, as a table");
    CLI::Option* full = command.add_flag("--full", options->validation.full, "the tolerances of the cases; minutes");
    command.add_flag("--quick")->description("tolerances of 1 %; the default")->excludes(full);
    command.add_option("--case", options->validation.only, "only the cases whose name contains this")
        ->type_name("TEXT");
    command.add_option("--seed", options->validation.seed, "another seed, other noise")->type_name("N");
    command.add_option("--threads", options->validation.threads, "0: all processors; the result does not depend on it")
        ->type_name("N")
        ->check(CLI::Range(0, 1024));
    command.add_option("--html", options->html, "also a page with plots: DIR/index.html")->type_name("DIR");
    command.add_flag("--json", options->json, "for programs, on standard output");
    command
        .add_option("--perturb", options->perturb,
                    "self-test: 2 % of error in direct, specular, ambient, sky or glass; rows must fail")
        ->type_name("NAME");
    command.footer(examples);
    command.callback([options, &status] { status = validate(*options, std::cout); });
}

} // namespace lightwell
