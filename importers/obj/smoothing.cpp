#include "importers/obj/smoothing.h"

#include <cmath>
#include <string>

namespace lightwell {
namespace {

/// Cosine of 66 degrees: a hexagonal column (60 degrees) is smoothed, a pentagonal one (72) keeps its edges.
constexpr double crease_cosine = 0.4067366430758002;
/// Faces around a point with more of them than this stay flat: comparing them in pairs would take for ever.
constexpr std::size_t most_compared = 1024;
/// Normals of one point that differ by less are one.
constexpr double same_normal = 1e-9;

/// One corner of a smoothed face at a point.
struct Spoke {
    std::uint32_t corner, group;
    Direction front;
    double angle_rad;
};

bool lacks_normals(const ObjFile& file, const ObjFace& face)
{
    if (face.smoothing == 0)
        return false;
    for (std::uint32_t i = face.first; i < face.first + face.count; ++i)
        if (file.corners[i].normal >= 0)
            return false;
    return true;
}

Direction front_of(const ObjFile& file, const ObjFace& face)
{
    const auto at = [&](std::uint32_t i) {
        return file.points[static_cast<std::size_t>(file.corners[face.first + i].point)];
    };
    const Point origin = at(0);
    Vec3 twice_area;
    for (std::uint32_t i = 1; i + 1 < face.count; ++i)
        twice_area += cross(at(i) - origin, at(i + 1) - origin);
    return normalized(twice_area);
}

double angle_at(const ObjFile& file, const ObjFace& face, std::uint32_t i)
{
    const auto at = [&](std::uint32_t k) {
        return file.points[static_cast<std::size_t>(file.corners[face.first + k % face.count].point)];
    };
    const Vec3 ahead = normalized(at(i + 1) - at(i)), back = normalized(at(i + face.count - 1) - at(i));
    return std::acos(std::fmin(1, std::fmax(-1, dot(ahead, back))));
}

/// The spokes of all points: those of point p are [starts[p], starts[p + 1]).
struct Wheel {
    std::vector<std::size_t> starts;
    std::vector<Spoke> spokes;
};

Wheel spokes_of(const ObjFile& file, const std::vector<const ObjFace*>& faces)
{
    Wheel wheel;
    wheel.starts.assign(file.points.size() + 1, 0);
    for (const ObjFace* face : faces)
        for (std::uint32_t i = face->first; i < face->first + face->count; ++i)
            ++wheel.starts[static_cast<std::size_t>(file.corners[i].point) + 1];
    for (std::size_t p = 1; p < wheel.starts.size(); ++p)
        wheel.starts[p] += wheel.starts[p - 1];
    wheel.spokes.resize(wheel.starts.back());
    std::vector<std::size_t> next(wheel.starts.begin(), wheel.starts.end() - 1);
    for (const ObjFace* face : faces) {
        const Direction front = front_of(file, *face);
        for (std::uint32_t i = 0; i < face->count; ++i) {
            const std::uint32_t corner = face->first + i;
            wheel.spokes[next[static_cast<std::size_t>(file.corners[corner].point)]++] = {
                corner, face->smoothing, front, angle_at(file, *face, i)};
        }
    }
    return wheel;
}

Direction mean_around(const Spoke& own, const Spoke* spokes, std::size_t count)
{
    Vec3 sum;
    for (const Spoke* spoke = spokes; spoke != spokes + count; ++spoke)
        if (spoke->group == own.group && dot(spoke->front, own.front) >= crease_cosine)
            sum += spoke->angle_rad * spoke->front;
    return normalized(sum);
}

/// Gives the spokes of one point their normals; equal ones are stored once.
void settle_point(ObjFile& file, const Spoke* spokes, std::size_t count)
{
    if (count > most_compared)
        return;
    const std::size_t first = file.normals.size();
    for (const Spoke* spoke = spokes; spoke != spokes + count; ++spoke) {
        const Direction normal = mean_around(*spoke, spokes, count);
        std::size_t known = first;
        while (known < file.normals.size() && max_abs(file.normals[known] - normal) > same_normal)
            ++known;
        if (known == file.normals.size())
            file.normals.push_back(normal);
        file.corners[spoke->corner].normal = static_cast<std::int32_t>(known);
    }
}

} // namespace

void smooth_groups(ObjFile& file)
{
    std::vector<const ObjFace*> faces;
    for (const ObjFace& face : file.faces)
        if (lacks_normals(file, face))
            faces.push_back(&face);
    if (faces.empty())
        return;
    const Wheel wheel = spokes_of(file, faces);
    for (std::size_t p = 0; p + 1 < wheel.starts.size(); ++p)
        settle_point(file, &wheel.spokes[wheel.starts[p]], wheel.starts[p + 1] - wheel.starts[p]);
    file.report.add(
        Finding::converted, file.name + ":" + std::to_string(faces.front()->line) + ": face",
        "smoothing group without vertex normals: they are the means over its faces, up to a turn of 66 degrees",
        faces.size());
}

} // namespace lightwell
