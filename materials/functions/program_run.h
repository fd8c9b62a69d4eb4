#pragma once

#include "materials/functions/library_functions.h"
#include "materials/functions/program.h"

/// \file What compiling and evaluating share; nothing outside materials/functions includes it.
namespace lightwell {

/// One evaluation of a program.
class ProgramRun {
public:
    ProgramRun(const Program& program, std::span<const double> channels, const WorkLimits& limits) noexcept;

    double value(std::uint32_t root) noexcept { return eval(root, nullptr); }
    /// The value of a node when it depends on nothing but the program and nothing goes wrong.
    bool constant(std::uint32_t node, double& value) noexcept;
    /// Whether the limits of work have ended it.
    bool stopped() const noexcept { return stopped_; }
    /// Whether something had no value.
    bool in_trouble() const noexcept { return trouble_ || stopped_; }

private:
    using Node = Program::Node;
    struct Frame;
    /// An argument on its way: worked out on first use, in the frame of whoever passed it.
    struct Argument {
        std::uint32_t node;
        bool known;
        double value;
        Frame* caller;
    };
    struct Frame {
        Argument* arguments;
        std::uint32_t count;
    };
    struct Slot {
        std::uint64_t evaluation = 0;
        double value = 0;
    };

    double eval(std::uint32_t at, Frame* frame) noexcept;
    double eval_deeper(const Node& node, Frame* frame) noexcept;
    double power(double base, double exponent) noexcept;
    double divided(double a, double b) noexcept;
    double parameter(std::uint32_t index, Frame* frame) noexcept;
    double variable(std::uint32_t index) noexcept;
    double argument(const Node& node, Frame* frame) noexcept;
    double call_library(const Node& node, std::uint32_t function, Frame* frame) noexcept;
    template <std::uint32_t Room>
    double library_value(const Node& node, const LibraryFunction& library, std::uint32_t count, Frame* frame) noexcept;
    double call_function(const Node& node, std::uint32_t function, Frame* frame) noexcept;
    double call_parameter(const Node& node, Frame* frame) noexcept;
    template <std::uint32_t Room>
    double call(const Node& node, const Program::Function& function, Frame* frame) noexcept;
    double failed() noexcept
    {
        trouble_ = true;
        return 0;
    }
    double checked(double value) noexcept { return value - value == 0 ? value : failed(); }

    const Program& program_;
    std::span<const double> channels_;
    WorkLimits limits_;
    std::uint64_t steps_ = 0;
    int depth_ = 0;
    bool trouble_ = false, stopped_ = false, asked_channel_ = false;
    std::uint64_t evaluation_;
    Slot* slots_;
};

} // namespace lightwell
