#include "materials/functions/program_run.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

ProgramRun::ProgramRun(const Program& program, std::span<const double> channels, const WorkLimits& limits) noexcept
    : program_(program), channels_(channels), limits_(limits)
{
    // Values of variables, one array for each thread; the number of the evaluation says whose they are.
    static thread_local std::vector<Slot> slots;
    static thread_local std::uint64_t evaluation = 0;
    if (slots.size() < program.variables_.size())
        slots.resize(program.variables_.size());
    slots_ = slots.data();
    evaluation_ = ++evaluation;
}

bool ProgramRun::constant(std::uint32_t node, double& value) noexcept
{
    value = eval(node, nullptr);
    return !in_trouble() && !asked_channel_;
}

double ProgramRun::eval(std::uint32_t at, Frame* frame) noexcept
{
    using Op = Node::Op;
    for (;;) {
        const Node& node = program_.nodes_[at];
        if (++steps_ > limits_.steps || stopped_) {
            stopped_ = true;
            return 0;
        }
        switch (node.op) {
        case Op::number:
            return node.number;
        case Op::channel:
            asked_channel_ = true;
            return node.index < channels_.size() ? channels_[node.index] : 0;
        case Op::choose: // the chosen operand takes the place of the whole
            at = program_.links_[node.first + (eval(program_.links_[node.first], frame) > 0 ? 1 : 2)];
            continue;
        case Op::undefined:
        case Op::function_name:
        case Op::library_name:
            return failed();
        default:
            break;
        }
        if (depth_ >= limits_.depth) {
            stopped_ = true;
            return 0;
        }
        ++depth_;
        const double value = eval_deeper(node, frame);
        --depth_;
        return value;
    }
}

double ProgramRun::eval_deeper(const Node& node, Frame* frame) noexcept
{
    using Op = Node::Op;
    const std::uint32_t* operands = program_.links_.data() + node.first;
    switch (node.op) {
    case Op::negate:
        return -eval(operands[0], frame);
    case Op::add: {
        const double left = eval(operands[0], frame);
        return left + eval(operands[1], frame);
    }
    case Op::subtract: {
        const double left = eval(operands[0], frame);
        return left - eval(operands[1], frame);
    }
    case Op::multiply: {
        const double left = eval(operands[0], frame);
        return left * eval(operands[1], frame);
    }
    case Op::divide: {
        const double left = eval(operands[0], frame);
        return divided(left, eval(operands[1], frame));
    }
    case Op::power: {
        const double left = eval(operands[0], frame);
        return power(left, eval(operands[1], frame));
    }
    case Op::parameter:
        return parameter(node.index, frame);
    case Op::variable:
        return variable(node.index);
    case Op::argument_list:
    case Op::select:
        return argument(node, frame);
    case Op::call_library:
        return call_library(node, node.index, frame);
    case Op::call_function:
        return call_function(node, node.index, frame);
    default:
        return call_parameter(node, frame);
    }
}

double ProgramRun::divided(double a, double b) noexcept
{
    return b == 0 ? failed() : a / b;
}

double ProgramRun::power(double base, double exponent) noexcept
{
    // No power: roots of negative numbers, 0 to a negative one, what is too large.
    const double value = exponent == 2 ? base * base : std::pow(base, exponent);
    return checked(value);
}

double ProgramRun::parameter(std::uint32_t index, Frame* frame) noexcept
{
    Argument& argument = frame->arguments[index];
    if (!argument.known) {
        argument.value = eval(argument.node, argument.caller);
        argument.known = true;
    }
    return argument.value;
}

double ProgramRun::variable(std::uint32_t index) noexcept
{
    if (slots_[index].evaluation == evaluation_)
        return slots_[index].value;
    const double value = eval(program_.variables_[index], nullptr);
    slots_[index] = {evaluation_, value};
    return value;
}

/// arg(n), counted from 1, 0 the number of them; select(n, a, b, ...), 0 the number of what can be chosen.
double ProgramRun::argument(const Node& node, Frame* frame) noexcept
{
    const std::uint32_t* operands = program_.links_.data() + node.first;
    const double wanted = std::floor(eval(operands[0], frame) + 0.5);
    const bool of_select = node.op == Node::Op::select;
    const std::size_t count = of_select ? node.count - 1 : program_.arguments_.size();
    if (wanted == 0)
        return static_cast<double>(count);
    if (!(wanted >= 1 && wanted <= static_cast<double>(count)))
        return failed();
    const auto chosen = static_cast<std::size_t>(wanted);
    return of_select ? eval(operands[chosen], frame) : program_.arguments_[chosen - 1];
}

double ProgramRun::call_library(const Node& node, std::uint32_t function, Frame* frame) noexcept
{
    const LibraryFunction& library = library_function(function);
    if (node.count < library.least_arguments)
        return failed();
    const std::uint32_t count = library.any_count ? node.count : library.least_arguments;
    // Little room for the usual call, so that recursion takes little of the stack.
    constexpr std::uint32_t usual = 6;
    if (count <= usual)
        return library_value<usual>(node, library, count, frame);
    return library_value<most_arguments>(node, library, count, frame);
}

template <std::uint32_t Room>
double ProgramRun::library_value(const Node& node, const LibraryFunction& library, std::uint32_t count,
                                 Frame* frame) noexcept
{
    double values[Room];
    for (std::uint32_t i = 0; i < count; ++i)
        values[i] = eval(program_.links_[node.first + i], frame);
    return checked(library.value(values, count));
}

template <std::uint32_t Room>
double ProgramRun::call(const Node& node, const Program::Function& function, Frame* frame) noexcept
{
    Argument arguments[Room];
    Frame own{arguments, function.parameters};
    for (std::uint32_t i = 0; i < function.parameters; ++i) {
        const std::uint32_t passed = program_.links_[node.first + i];
        const bool eager = program_.nodes_[passed].eager;
        arguments[i] = {passed, eager, eager ? eval(passed, frame) : 0, frame};
    }
    return eval(function.body, &own);
}

double ProgramRun::call_function(const Node& node, std::uint32_t function, Frame* frame) noexcept
{
    const Program::Function& called = program_.functions_[function];
    if (node.count < called.parameters)
        return failed();
    if (called.parameters <= 3)
        return call<3>(node, called, frame);
    if (called.parameters <= 8)
        return call<8>(node, called, frame);
    return call<32>(node, called, frame);
}

double ProgramRun::call_parameter(const Node& node, Frame* frame) noexcept
{
    // A parameter may hold a parameter of whoever called.
    const Frame* holder = frame;
    std::uint32_t index = node.index;
    for (;;) {
        const Argument& argument = holder->arguments[index];
        const Node& held = program_.nodes_[argument.node];
        if (held.op == Node::Op::function_name)
            return call_function(node, held.index, frame);
        if (held.op == Node::Op::library_name)
            return call_library(node, held.index, frame);
        if (held.op != Node::Op::parameter)
            return failed();
        holder = argument.caller;
        index = held.index;
    }
}

bool Program::evaluate(std::span<const double> channels, std::span<double> values) const noexcept
{
    ProgramRun run(*this, channels, limits_);
    for (std::size_t i = 0; i < roots_.size(); ++i)
        values[i] = run.value(roots_[i]);
    if (run.stopped())
        std::fill(values.begin(), values.end(), 0.0);
    return !run.in_trouble();
}

} // namespace lightwell
