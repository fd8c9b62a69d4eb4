#pragma once

#include "importers/generators/scene_text_out.h"
#include "materials/functions/program.h"

namespace lightwell::generators {

/// The functions that the words of a generator give, and what `-e` and `-f` define beside them.
class CurveFunctions {
public:
    explicit CurveFunctions(const GeneratorInput& input);
    /// `-e EXPRESSION` or `-f FILE`; false for another option.
    bool option(const std::string& word, WordReader& words);
    /// @param parameters  `t` or `s,t`
    void add(const std::string& name, const std::string& parameters, const std::string& expression);
    bool has(const std::string& name) const;
    /// To be called when everything is defined.
    /// @param calls  `name($1)` each
    void compile(const std::vector<std::string>& calls);
    /// @throws BadWords when a value is not finite or has none
    std::vector<double> values(std::initializer_list<double> at) const;

private:
    const GeneratorInput& input_;
    Definitions definitions_;
    std::optional<Program> program_;
};

} // namespace lightwell::generators
