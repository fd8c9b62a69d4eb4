#pragma once

#include "importers/gltf/gltf_document.h"

#include <optional>
#include <string>
#include <vector>

namespace lightwell {

/// The nodes that the scene shows, walked once, parents before children.
class GltfTree {
public:
    /// @param to_metres  file coordinates to metres, z up
    /// @throws InputError when nodes form a circle or have two parents
    GltfTree(const GltfDocument& document, const Affine& to_metres);

    const std::vector<int>& order() const noexcept { return order_; }
    /// Node -> metres; nothing for a node that is not shown.
    const std::optional<Affine>& world(int node) const { return worlds_.at(static_cast<std::size_t>(node)); }
    /// `extras.layer` of the node or its nearest ancestor that has one, else the nearest name; empty when there is
    /// none.
    std::string layer_of(int node) const;
    /// Names from the root down, "/" between them; of very deep trees only the nearest 32, behind "...".
    std::string path_of(int node) const;

private:
    struct Step {
        int node;
        Affine to_parent;
    };
    std::vector<Step> roots(const Affine& to_metres) const;
    void visit(const Step& step);

    const GltfDocument& document_;
    std::vector<int> parents_;
    std::vector<int> order_;
    std::vector<std::optional<Affine>> worlds_;
    std::vector<int> with_layer_, with_name_; ///< the node itself or its nearest ancestor that has one; -1: none
};

/// The name, or the kind of thing and its number.
std::string name_or_number(const std::string& name, const char* kind, std::size_t number);

} // namespace lightwell
