#include "importers/gltf/gltf_tree.h"

#include "engine/base/errors.h"

namespace lightwell {
namespace {

/// Paths of a chain of nodes would fill the memory with the square of its length.
constexpr int most_names_in_path = 32;

/// Twice the same parent, or a circle, would be walked for ever or exponentially often.
std::vector<int> parents_of(const GltfDocument& document)
{
    std::vector<int> parents(document.nodes.size(), -1);
    for (std::size_t i = 0; i < document.nodes.size(); ++i)
        for (const int child : document.nodes[i].children) {
            const std::string place = document.name + ": node " + std::to_string(i);
            if (child < 0 || static_cast<std::size_t>(child) >= parents.size())
                throw InputError(place, "has child " + std::to_string(child) + " of " + std::to_string(parents.size()) +
                                            " nodes");
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent >= 0 || static_cast<std::size_t>(child) == i)
                throw InputError(place, "node " + std::to_string(child) + " has two parents or is its own",
                                 "nodes must form trees");
            parent = static_cast<int>(i);
        }
    return parents;
}

} // namespace

GltfTree::GltfTree(const GltfDocument& document, const Affine& to_metres)
    : document_(document), parents_(parents_of(document)), worlds_(document.nodes.size()),
      with_layer_(document.nodes.size(), -1), with_name_(document.nodes.size(), -1)
{
    std::vector<Step> open = roots(to_metres);
    while (!open.empty()) {
        const Step step = open.back();
        open.pop_back();
        visit(step);
        const GltfNode& node = document_.nodes[static_cast<std::size_t>(step.node)];
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            open.push_back({*child, *world(step.node)});
    }
}

std::vector<GltfTree::Step> GltfTree::roots(const Affine& to_metres) const
{
    std::vector<Step> steps;
    for (auto root = document_.roots.rbegin(); root != document_.roots.rend(); ++root) {
        if (*root < 0 || static_cast<std::size_t>(*root) >= parents_.size())
            throw InputError(document_.name, "scene refers to node " + std::to_string(*root) + " of " +
                                                 std::to_string(parents_.size()));
        if (parents_[static_cast<std::size_t>(*root)] >= 0)
            throw InputError(document_.name,
                             "node " + std::to_string(*root) + " is a root of the scene and has a parent",
                             "nodes must form trees");
        steps.push_back({*root, to_metres});
    }
    return steps;
}

void GltfTree::visit(const Step& step)
{
    const auto index = static_cast<std::size_t>(step.node);
    if (worlds_[index])
        throw InputError(document_.name, "node " + std::to_string(step.node) + " stands in the scene twice",
                         "nodes must form trees");
    const GltfNode& node = document_.nodes[index];
    worlds_[index] = compose(step.to_parent, node.to_parent);
    order_.push_back(step.node);
    const int parent = parents_[index];
    const auto above = static_cast<std::size_t>(parent);
    with_layer_[index] = !node.layer.empty() ? step.node : parent < 0 ? -1 : with_layer_[above];
    with_name_[index] = !node.name.empty() ? step.node : parent < 0 ? -1 : with_name_[above];
}

std::string GltfTree::layer_of(int node) const
{
    const auto index = static_cast<std::size_t>(node);
    if (with_layer_[index] >= 0)
        return document_.nodes[static_cast<std::size_t>(with_layer_[index])].layer;
    return with_name_[index] >= 0 ? document_.nodes[static_cast<std::size_t>(with_name_[index])].name : std::string();
}

std::string GltfTree::path_of(int node) const
{
    std::vector<int> names;
    while (node >= 0 && static_cast<int>(names.size()) < most_names_in_path) {
        names.push_back(node);
        node = parents_[static_cast<std::size_t>(node)];
    }
    std::string path = node >= 0 ? ".../" : "";
    for (auto at = names.rbegin(); at != names.rend(); ++at) {
        const auto index = static_cast<std::size_t>(*at);
        path += name_or_number(document_.nodes[index].name, "node", index);
        path += *at == names.front() ? "" : "/";
    }
    return path;
}

std::string name_or_number(const std::string& name, const char* kind, std::size_t number)
{
    if (!name.empty())
        return name;
    std::string made = kind;
    return made.append(std::to_string(number));
}

} // namespace lightwell
