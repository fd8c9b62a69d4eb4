#include "engine/base/errors.h"
#include "engine/base/vector.h"
#include "materials/functions/library_functions.h"
#include "materials/functions/program.h"
#include "materials/functions/program_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lightwell {

/// Turns expressions into nodes; each variable and function once, whoever refers to it.
class ProgramCompiler {
public:
    using Node = Program::Node;
    using Op = Node::Op;

    ProgramCompiler(const Definitions& definitions, const std::vector<double>& arguments, const std::string& place)
        : definitions_(definitions), place_(place)
    {
        program_.arguments_ = arguments;
    }

    Program compile(const Definition& definition)
    {
        program_.roots_.push_back(variable(definition));
        return finished();
    }
    Program compile(const std::vector<std::string>& expressions, const std::string& context)
    {
        std::vector<Expression> parsed;
        for (const std::string& text : expressions)
            parsed.push_back(parse_expression(text, place_));
        for (const Expression& expression : parsed)
            program_.roots_.push_back(add(expression, {context.empty() ? "" : '`' + context, nullptr, place_}));
        return finished();
    }

private:
    Program finished()
    {
        fold_all();
        check_reachable();
        check_arguments();
        return std::move(program_);
    }

    /// Where an expression stands: what its names mean.
    struct Place {
        std::string context;
        const std::vector<std::string>* parameters;
        std::string file;
    };
    /// More nodes than any set of function files comes to; the deepest chain of definitions.
    static constexpr std::size_t most_nodes = 1'000'000;
    static constexpr int deepest_chain = 2000;

    std::uint32_t keep(Node node, const std::vector<std::uint32_t>& operands)
    {
        node.first = static_cast<std::uint32_t>(program_.links_.size());
        node.count = static_cast<std::uint32_t>(operands.size());
        program_.links_.insert(program_.links_.end(), operands.begin(), operands.end());
        program_.nodes_.push_back(node);
        if (program_.nodes_.size() > most_nodes)
            throw InputError{place_, "functions of more than a million operations", "check generated function files"};
        return static_cast<std::uint32_t>(program_.nodes_.size() - 1);
    }
    std::uint32_t leaf(Op op, std::uint32_t index, double number = 0)
    {
        Node node;
        node.op = op;
        node.index = index;
        node.number = number;
        return keep(node, {});
    }
    std::uint32_t problem(const Expression& at, const Place& place, const std::string& what)
    {
        program_.problems_.push_back(place.file + ':' + std::to_string(at.line) + ": " + what);
        return leaf(Op::undefined, static_cast<std::uint32_t>(program_.problems_.size() - 1));
    }

    std::uint32_t add(const Expression& expression, const Place& place)
    {
        switch (expression.kind) {
        case Expression::Kind::number:
            return leaf(Op::number, 0, expression.number);
        case Expression::Kind::channel:
            if (expression.number == 0)
                return leaf(Op::number, 0, 0);
            return leaf(Op::channel, static_cast<std::uint32_t>(expression.number) - 1);
        case Expression::Kind::name:
            return add_name(expression, place);
        case Expression::Kind::call:
            return add_call(expression, place);
        default:
            break;
        }
        static constexpr Op ops[] = {Op::negate, Op::add, Op::subtract, Op::multiply, Op::divide, Op::power};
        Node node;
        node.op = ops[static_cast<int>(expression.kind) - static_cast<int>(Expression::Kind::negate)];
        return keep(node, operands(expression, place));
    }
    std::vector<std::uint32_t> operands(const Expression& expression, const Place& place)
    {
        std::vector<std::uint32_t> added;
        for (const Expression& part : expression.parts)
            added.push_back(add(part, place));
        return added;
    }
    static int parameter(const std::string& name, const Place& place)
    {
        if (place.parameters == nullptr)
            return -1;
        const auto found = std::find(place.parameters->begin(), place.parameters->end(), name);
        return found == place.parameters->end() ? -1 : static_cast<int>(found - place.parameters->begin());
    }
    std::uint32_t add_name(const Expression& expression, const Place& place)
    {
        if (const int own = parameter(expression.name, place); own >= 0)
            return leaf(Op::parameter, static_cast<std::uint32_t>(own));
        if (const Definition* found = definitions_.find(expression.name, place.context))
            return found->is_function ? leaf(Op::function_name, function(*found)) : variable(*found);
        if (const int library = find_library_function(expression.name); library >= 0)
            return leaf(Op::library_name, static_cast<std::uint32_t>(library));
        if (expression.name == "PI")
            return leaf(Op::number, 0, pi);
        return problem(expression, place, expression.name + " is not defined");
    }
    std::uint32_t add_call(const Expression& call, const Place& place)
    {
        const auto count = static_cast<std::uint32_t>(call.parts.size());
        if (count > most_arguments)
            throw InputError{place.file + ':' + std::to_string(call.line),
                             call.name + " has more than " + std::to_string(most_arguments) + " arguments"};
        Node node;
        const auto expect = [&](std::uint32_t least) { return count >= least; };
        const auto too_few = [&] { return problem(call, place, "too few arguments of " + call.name); };
        if (const int own = parameter(call.name, place); own >= 0) {
            node.op = Op::call_parameter;
            node.index = static_cast<std::uint32_t>(own);
        } else if (const Definition* found = definitions_.find(call.name, place.context)) {
            if (!found->is_function)
                return problem(call, place, call.name + " is a variable, no function");
            if (!expect(static_cast<std::uint32_t>(found->parameters.size())))
                return too_few();
            node.op = Op::call_function;
            node.index = function(*found);
        } else if (call.name == "if" || call.name == "select" || call.name == "arg") {
            node.op = call.name == "if" ? Op::choose : call.name == "arg" ? Op::argument_list : Op::select;
            if (!expect(call.name == "if" ? 3 : 1))
                return too_few();
        } else if (const int library = find_library_function(call.name); library >= 0) {
            node.op = Op::call_library;
            node.index = static_cast<std::uint32_t>(library);
            if (!expect(library_function(node.index).least_arguments))
                return too_few();
        } else {
            return problem(call, place, "function " + call.name + " is not defined");
        }
        return keep(node, operands(call, place));
    }

    /// Stops chains of definitions that are too long for the stack.
    struct Descent {
        explicit Descent(ProgramCompiler& compiler) : depth(compiler.depth_)
        {
            if (++depth > deepest_chain)
                throw InputError{compiler.place_, "definitions refer to definitions more than 2000 deep",
                                 "check generated function files"};
        }
        ~Descent() { --depth; }
        Descent(const Descent&) = delete;
        Descent& operator=(const Descent&) = delete;
        int& depth;
    };
    std::uint32_t variable(const Definition& definition)
    {
        const auto [entry, fresh] = variables_.try_emplace(&definition, program_.variables_.size());
        const auto index = static_cast<std::uint32_t>(entry->second);
        if (fresh) {
            const Descent descent(*this);
            program_.variables_.push_back(0);
            const std::uint32_t body = add(definition.body, {definition.context, nullptr, definition.file});
            program_.variables_[index] = body;
        }
        return leaf(Op::variable, index);
    }
    std::uint32_t function(const Definition& definition)
    {
        const auto [entry, fresh] = functions_.try_emplace(&definition, program_.functions_.size());
        const auto index = static_cast<std::uint32_t>(entry->second);
        if (fresh) {
            const Descent descent(*this);
            program_.functions_.push_back({0, static_cast<std::uint32_t>(definition.parameters.size())});
            const std::uint32_t body =
                add(definition.body, {definition.context, &definition.parameters, definition.file});
            program_.functions_[index].body = body;
        }
        return index;
    }

    // Folding: operands come before what uses them, except through functions and variables, so that a few passes over
    // the nodes in order reach everything.
    void fold_all()
    {
        constexpr int passes = 4;
        for (int pass = 0; pass < passes; ++pass)
            for (std::uint32_t i = 0; i < program_.nodes_.size(); ++i)
                fold(i);
        mark_eager();
    }
    const Node& operand(const Node& node, std::uint32_t i) const
    {
        return program_.nodes_[program_.links_[node.first + i]];
    }
    void fold(std::uint32_t at)
    {
        Node& node = program_.nodes_[at];
        if (node.op == Op::variable) {
            const Node& body = program_.nodes_[program_.variables_[node.index]];
            if (body.op == Op::number || body.op == Op::channel || body.op == Op::undefined)
                node = body;
            return;
        }
        if (node.op == Op::choose && operand(node, 0).op == Op::number) {
            node = operand(node, operand(node, 0).number > 0 ? 1 : 2);
            return;
        }
        if (node.op == Op::select && operand(node, 0).op == Op::number && fold_select(node))
            return;
        if (node.count == 0 || !all_numbers(node) || node.op == Op::call_parameter)
            return;
        if (node.op == Op::argument_list && operand(node, 0).number + 0.5 > missing_argument()) {
            const Node undefined = program_.nodes_[missing(operand(node, 0).number)];
            program_.nodes_[at] = undefined; // the list has grown: `node` may have moved
            return;
        }
        double value = 0;
        constexpr std::uint64_t enough = 10'000; // a constant that takes longer is worked out when it is needed
        ProgramRun run(program_, {}, {enough, WorkLimits{}.depth});
        if (run.constant(at, value)) {
            program_.nodes_[at].op = Op::number;
            program_.nodes_[at].number = value;
            program_.nodes_[at].count = 0;
        }
    }
    bool fold_select(Node& node)
    {
        const double chosen = std::floor(operand(node, 0).number + 0.5);
        if (!(chosen >= 1 && chosen < node.count))
            return false;
        node = operand(node, static_cast<std::uint32_t>(chosen));
        return true;
    }
    double missing_argument() const { return static_cast<double>(program_.arguments_.size()) + 1; }
    std::uint32_t missing(double number)
    {
        if (missing_ != none)
            return leaf(Op::undefined, missing_);
        program_.problems_.push_back("argument " + std::to_string(static_cast<long>(number + 0.5)) +
                                     " is asked for, but there are " + std::to_string(program_.arguments_.size()));
        missing_ = static_cast<std::uint32_t>(program_.problems_.size() - 1);
        return leaf(Op::undefined, missing_);
    }
    bool all_numbers(const Node& node) const
    {
        for (std::uint32_t i = 0; i < node.count; ++i)
            if (operand(node, i).op != Op::number)
                return false;
        return true;
    }
    void mark_eager()
    {
        for (Node& node : program_.nodes_) {
            const bool leaf_value = node.op == Op::number || node.op == Op::channel;
            const bool arithmetic =
                node.op == Op::negate || node.op == Op::add || node.op == Op::subtract || node.op == Op::multiply;
            node.eager = leaf_value || arithmetic;
            for (std::uint32_t i = 0; arithmetic && i < node.count; ++i)
                node.eager = node.eager && operand(node, i).eager;
        }
    }

    /// Arguments that are asked for whatever the conditions say must be there; behind a condition they may be missing.
    void check_arguments()
    {
        std::vector<char> seen(program_.nodes_.size());
        std::vector<std::uint32_t> waiting = program_.roots_;
        while (!waiting.empty()) {
            const std::uint32_t at = waiting.back();
            waiting.pop_back();
            if (std::exchange(seen[at], 1) != 0)
                continue;
            const Node& node = program_.nodes_[at];
            if (node.op == Op::undefined)
                throw InputError{place_, program_.problems_[node.index], "give the numbers that the function asks for"};
            if (node.op == Op::variable)
                waiting.push_back(program_.variables_[node.index]);
            if (node.op == Op::call_function)
                waiting.push_back(program_.functions_[node.index].body);
            if (node.op == Op::call_function || node.op == Op::call_parameter)
                continue;
            const bool conditional = node.op == Op::choose || node.op == Op::select;
            for (std::uint32_t i = 0; i < (conditional ? 1 : node.count); ++i)
                waiting.push_back(program_.links_[node.first + i]);
        }
    }
    /// What can be reached must be defined; finds the highest channel on the way.
    void check_reachable()
    {
        std::vector<char> seen(program_.nodes_.size());
        std::vector<std::uint32_t> waiting = program_.roots_;
        const auto reach = [&](std::uint32_t at) {
            if (!seen[at])
                waiting.push_back(at);
        };
        while (!waiting.empty()) {
            const std::uint32_t at = waiting.back();
            waiting.pop_back();
            if (std::exchange(seen[at], 1) != 0)
                continue;
            const Node& node = program_.nodes_[at];
            if (node.op == Op::undefined && node.index != missing_)
                throw InputError{place_, program_.problems_[node.index],
                                 "define it in the function file, or correct the name"};
            if (node.op == Op::channel)
                program_.highest_channel_ = std::max(program_.highest_channel_, static_cast<int>(node.index) + 1);
            for (std::uint32_t i = 0; i < node.count; ++i)
                reach(program_.links_[node.first + i]);
            if (node.op == Op::variable)
                reach(program_.variables_[node.index]);
            if (node.op == Op::call_function || node.op == Op::function_name)
                reach(program_.functions_[node.index].body);
        }
    }

    const Definitions& definitions_;
    const std::string& place_;
    Program program_;
    std::map<const Definition*, std::size_t> variables_, functions_;
    int depth_ = 0;
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    std::uint32_t missing_ = none; ///< the problem of an argument that was not given
};

Program Program::compile(const Definitions& definitions, const std::vector<std::string>& expressions,
                         const std::string& context, const std::vector<double>& arguments, const std::string& place)
{
    return ProgramCompiler(definitions, arguments, place).compile(expressions, context);
}

Program Program::compile_definition(const Definitions& definitions, const std::string& name, const std::string& place)
{
    const Definition* found = definitions.find(name, "");
    if (found == nullptr || found->is_function)
        throw InputError{place, name + " is not defined as a variable"};
    return ProgramCompiler(definitions, {}, place).compile(*found);
}

} // namespace lightwell
