#pragma once

#include "materials/functions/definitions.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lightwell {

/// Bounds on one evaluation, so that no function file can hang or exhaust the stack.
struct WorkLimits {
    std::uint64_t steps = 2'000'000; ///< operations
    int depth = 3000;                ///< operands, variables and functions that wait for each other
};

/// Expressions of the function-file language, compiled with all that they refer to. Values of variables are kept during
/// an evaluation, arguments are worked out on first use, what does not depend on channels is worked out once.
/// Thread-safe.
/// Error   as the processor's arithmetic. Division by zero, a root or logarithm of what has none, and an evaluation
///         beyond the limits give 0 and are counted.
class Program {
public:
    /// @param expressions  what evaluate() answers, in this order
    /// @param context      in which the names of the expressions are looked up, without backquote
    /// @param arguments    what arg(1), arg(2), ... answer
    /// @param place        for messages
    /// @throws InputError  syntax; a name that can be reached but is not defined; too few arguments of a function
    static Program compile(const Definitions& definitions, const std::vector<std::string>& expressions,
                           const std::string& context, const std::vector<double>& arguments, const std::string& place);
    /// The body of one variable or output channel (`$2`), as the only value.
    static Program compile_definition(const Definitions& definitions, const std::string& name,
                                      const std::string& place);

    /// @param channels  `$1` is channels[0]; those beyond are 0
    /// @param values    one for each expression
    /// @return          false when something had no value (see Error above)
    bool evaluate(std::span<const double> channels, std::span<double> values) const noexcept;
    std::size_t size() const noexcept { return roots_.size(); }
    /// Highest channel that any expression asks for; 0: none, all values are constant.
    int highest_channel() const noexcept { return highest_channel_; }
    void set_limits(const WorkLimits& limits) noexcept { limits_ = limits; }

    /// One operation; its operands are links_[first ... first + count).
    struct Node {
        enum class Op : std::uint8_t {
            number,
            channel,
            parameter,
            variable,
            negate,
            add,
            subtract,
            multiply,
            divide,
            power,
            call_function,  ///< index: of the function
            call_parameter, ///< index: of the parameter that holds the function
            call_library,   ///< index: of the library function
            choose,         ///< `if`
            select,
            argument_list,
            function_name,
            library_name,
            undefined ///< index: into problems_
        };
        Op op = Op::number;
        bool eager = false; ///< can neither fail nor take long: worked out when it is passed, not when it is used
        std::uint32_t index = 0, first = 0, count = 0;
        double number = 0;
    };
    struct Function {
        std::uint32_t body = 0, parameters = 0;
    };

private:
    friend class ProgramCompiler;
    friend class ProgramRun;
    Program() = default;

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> links_, roots_;
    std::vector<std::uint32_t> variables_; ///< body of each
    std::vector<Function> functions_;
    std::vector<double> arguments_; ///< of arg()
    std::vector<std::string> problems_;
    int highest_channel_ = 0;
    WorkLimits limits_;
};

} // namespace lightwell
