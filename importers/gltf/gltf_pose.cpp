#include "importers/gltf/gltf_pose.h"

#include "engine/base/errors.h"
#include "importers/gltf/gltf_accessor.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Four joints move a vertex at once; files with more have further sets.
constexpr int most_sets = 4;

void add_target(const GltfDocument& document, int accessor, double weight, std::vector<Vec3>& values)
{
    const std::vector<Vec3> moves = read_vectors(document, accessor);
    if (moves.size() != values.size())
        throw InputError(document.name + ": accessor " + std::to_string(accessor),
                         "morph target has " + std::to_string(moves.size()) + " elements, POSITION has " +
                             std::to_string(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] += weight * moves[i];
}

void morph(const GltfDocument& document, const GltfPrimitive& primitive, const std::vector<double>& weights,
           std::vector<Point>& points, std::vector<Vec3>& normals)
{
    for (std::size_t k = 0; k < std::min(weights.size(), primitive.targets.size()); ++k) {
        const std::map<std::string, int>& target = primitive.targets[k];
        if (weights[k] == 0 || !std::isfinite(weights[k]))
            continue;
        if (const auto found = target.find("POSITION"); found != target.end())
            add_target(document, found->second, weights[k], points);
        if (const auto found = target.find("NORMAL"); found != target.end() && !normals.empty())
            add_target(document, found->second, weights[k], normals);
    }
}

/// Adds weight * map to a sum of maps.
void add(Affine& sum, const Affine& map, double weight)
{
    sum.x += weight * map.x;
    sum.y += weight * map.y;
    sum.z += weight * map.z;
    sum.translation += weight * map.translation;
}

/// The weighted mean of the bones' maps for each vertex.
std::vector<Affine> blended(const GltfDocument& document, const GltfPrimitive& primitive,
                            const std::vector<Affine>& joints, std::size_t count)
{
    std::vector<Affine> maps(count, Affine{{}, {}, {}, {}});
    std::vector<double> totals(count);
    for (int set = 0; set < most_sets; ++set) {
        const std::string number = std::to_string(set);
        const auto bones = primitive.attributes.find("JOINTS_" + number);
        const auto shares = primitive.attributes.find("WEIGHTS_" + number);
        if (bones == primitive.attributes.end() || shares == primitive.attributes.end())
            break;
        const std::string place = document.name + ": accessor " + std::to_string(bones->second);
        const std::vector<double> joint = read_numbers(document, bones->second, 4);
        const std::vector<double> weight = read_numbers(document, shares->second, 4);
        if (joint.size() != 4 * count || weight.size() != 4 * count)
            throw InputError(place, "joints or weights are not one for each vertex");
        for (std::size_t i = 0; i < 4 * count; ++i) {
            if (!(weight[i] > 0))
                continue;
            if (!(joint[i] >= 0) || joint[i] >= static_cast<double>(joints.size()))
                throw InputError(place, "joint " + std::to_string(joint[i]) + " of " + std::to_string(joints.size()));
            add(maps[i / 4], joints[static_cast<std::size_t>(joint[i])], weight[i]);
            totals[i / 4] += weight[i];
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (totals[i] > 0)
            maps[i] = {maps[i].x / totals[i], maps[i].y / totals[i], maps[i].z / totals[i],
                       maps[i].translation / totals[i]};
        else
            maps[i] = joints[0];
    }
    return maps;
}

} // namespace

void take_pose(const GltfDocument& document, const GltfPrimitive& primitive, const GltfPose& pose,
               std::vector<Point>& points, std::vector<Vec3>& normals)
{
    morph(document, primitive, pose.weights, points, normals);
    if (pose.joints.empty())
        return;
    const std::vector<Affine> maps = blended(document, primitive, pose.joints, points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = maps[i].point(points[i]);
    for (std::size_t i = 0; i < normals.size(); ++i)
        normals[i] = transform_normal(maps[i], normals[i]);
}

} // namespace lightwell
