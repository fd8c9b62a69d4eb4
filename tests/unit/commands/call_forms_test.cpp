#include "tests/unit/commands/command_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

/// \file The forms in which other programs call the commands, as they stand in plugins/commands/call-forms.md.
namespace lightwell::commands {
namespace {

struct CallForm {
    std::string line, input;
    std::string shown; ///< a pattern that the output, the messages or the log holds
    int status = 0;
};

/// The rows of the table: `| command line | what comes by standard input | what is looked for | status |`.
std::vector<CallForm> table()
{
    std::ifstream file(LIGHTWELL_ROOT "/plugins/commands/call-forms.md");
    std::vector<CallForm> forms;
    for (std::string line; std::getline(file, line);) {
        static const std::regex row(R"(^\| `([^`]+)` \| (-|`[^`]*`) \| `([^`]+)` \| ([0-9]) \|)");
        std::smatch cells;
        if (!std::regex_match(line, cells, row))
            continue;
        const std::string input = cells[2] == "-" ? "" : cells[2].str().substr(1, cells[2].length() - 2);
        forms.push_back({cells[1], input, cells[3], std::stoi(cells[4])});
    }
    return forms;
}

/// Words of a line as a shell makes them: blanks within '...' do not part, `\t` and `\n` are as printf has them.
std::vector<std::string> shell_words(const std::string& line)
{
    std::vector<std::string> words;
    bool quoted = false, begun = false;
    for (const char c : line) {
        if (c == '\'') {
            quoted = !quoted;
            if (!begun)
                words.emplace_back();
            begun = true;
        } else if (c == ' ' && !quoted) {
            begun = false;
        } else if (c != '\\') { // a | within a table stands behind one
            if (!begun)
                words.emplace_back();
            begun = true;
            words.back() += c;
        }
    }
    return words;
}

std::string with_escapes(std::string text)
{
    for (const auto& [escape, character] : {std::pair{"\\n", "\n"}, std::pair{"\\t", "\t"}})
        for (std::size_t at = 0; (at = text.find(escape, at)) != std::string::npos;)
            text.replace(at, 2, character);
    return text;
}

/// The files that the forms name.
void make_files(const WorkFolder& folder)
{
    folder.write("room.rad", "void light lamp 0 0 3 100 100 100\nlamp sphere s 0 0 4 0 0 2 .1\n"
                             "void plastic grey 0 0 5 .5 .5 .5 0 0\n"
                             "grey polygon floor 0 0 12 -5 -5 0 5 -5 0 5 5 0 -5 5 0\n");
    folder.write("more.rad", "grey sphere ball 0 0 4 1 1 1 .2\n");
    folder.write("sky.rad", "void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 180\n");
    folder.write("dir/part.rad", "grey sphere ball 0 0 4 1 1 1 .2\n");
    folder.write("view.vf", "rvu -vtv -vp 0 -4 1 -vd 0 1 0 -vu 0 0 1 -vh 40 -vv 30\n");
    folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng roof\nusemtl red\nf 1 2 3\n");
    folder.write("rules.map", "plain ; tin (Group roof) ;\n");
    folder.write("own.cal", "twice(x) : 2*x;\n");
    folder.write("lamp.ies", "IESNA:LM-63-2002\n[TEST] x\nTILT=NONE\n1 1000 1 3 1 1 2 .2 .4 0\n1 1 10\n0 45 90\n0\n358 "
                             "179 0\n");
    std::ofstream("room.oct", std::ios::binary) << run("oconv -f room.rad").out;
    std::ofstream("picture.hdr", std::ios::binary) << run("rpict -vf view.vf -x 8 -y 8 -ab 0 room.oct").out;
}

/// Runs a row: several commands with `|` between them, the last of which shows its result.
Ran run_form(const CallForm& form)
{
    std::string input = with_escapes(form.input);
    if (!form.input.empty() && form.input[0] == '<')
        input = WorkFolder::read(form.input.substr(1));
    Ran ran;
    std::string err;
    std::vector<std::string> command;
    std::vector<std::string> words = shell_words(form.line);
    words.emplace_back("|");
    for (const std::string& word : words) {
        if (word != "|") {
            command.push_back(word);
            continue;
        }
        ran = run(command, input);
        err += ran.err;
        input = ran.out;
        command.clear();
    }
    ran.err = err;
    return ran;
}

TEST(CallForms, EveryFormOfTheTableGivesWhatItsCallerLooksFor)
{
    const std::vector<CallForm> forms = table();
    EXPECT_GE(forms.size(), 83u);
    for (const CallForm& form : forms) {
        SCOPED_TRACE(form.line);
        const WorkFolder folder;
        std::filesystem::create_directory("dir");
        make_files(folder);
        const Ran ran = run_form(form);
        EXPECT_EQ(ran.status, form.status) << ran.err;
        const std::string log = std::filesystem::exists("log.txt") ? WorkFolder::read("log.txt") : "";
        const std::string all = ran.out + ran.err + log;
        EXPECT_TRUE(std::regex_search(all, std::regex(form.shown))) << all.substr(0, 600) << "\nlog: " << log;
        if (form.status == 0) {
            EXPECT_EQ(ran.err.find("fatal"), std::string::npos) << ran.err;
        }
    }
}

TEST(CallForms, EveryCommandHasAFormInTheTable)
{
    const std::vector<CallForm> forms = table();
    for (const std::string& name : command_names())
        EXPECT_TRUE(std::any_of(forms.begin(), forms.end(), [&](const CallForm& form) {
            return shell_words(form.line).at(0) == name;
        })) << name;
}

} // namespace
} // namespace lightwell::commands
