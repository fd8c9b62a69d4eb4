#include "engine/geometry/cage_faces.h"

#include "engine/base/errors.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <set>
#include <utility>

namespace lightwell {
namespace {

using namespace OpenSubdiv;

/// Levels at which points with other than four edges are replaced by a patch that only nearly fits. At 4 the tangents
/// of a cube's corners are true within 1e-3; each level more takes a quarter of that and more memory.
constexpr int irregular_level = 4;
/// Corners of the surface's array are x, y, z one after the other.
constexpr int numbers_per_point = 3;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The cage in the words of the library, which keeps pointers only: the arrays live here.
struct Topology {
    std::vector<int> sizes, corners, crease_points, tips, holes;
    std::vector<float> crease_sharpness, tip_sharpness;
    std::size_t creases_left_out = 0;
};

std::set<Edge> edges_of(const SubdivisionCage& cage)
{
    std::set<Edge> edges;
    std::size_t first = 0;
    for (const std::uint32_t size : cage.face_sizes) {
        for (std::uint32_t i = 0; i < size; ++i)
            edges.insert(std::minmax(cage.corners[first + i], cage.corners[first + (i + 1) % size]));
        first += size;
    }
    return edges;
}

Topology topology_of(const SubdivisionCage& cage)
{
    Topology topology;
    topology.sizes.assign(cage.face_sizes.begin(), cage.face_sizes.end());
    topology.corners.assign(cage.corners.begin(), cage.corners.end());
    topology.holes.assign(cage.holes.begin(), cage.holes.end());
    const std::set<Edge> edges = cage.creases.empty() ? std::set<Edge>{} : edges_of(cage);
    for (const SubdivisionCage::Crease& crease : cage.creases) {
        if (!edges.contains(std::minmax(crease.from, crease.to))) {
            ++topology.creases_left_out;
            continue;
        }
        topology.crease_points.push_back(static_cast<int>(crease.from));
        topology.crease_points.push_back(static_cast<int>(crease.to));
        topology.crease_sharpness.push_back(static_cast<float>(std::fmin(crease.sharpness, fully_sharp)));
    }
    for (const SubdivisionCage::Tip& tip : cage.tips) {
        topology.tips.push_back(static_cast<int>(tip.point));
        topology.tip_sharpness.push_back(static_cast<float>(std::fmin(tip.sharpness, fully_sharp)));
    }
    return topology;
}

std::unique_ptr<Far::TopologyRefiner> refiner_of(const SubdivisionCage& cage, const Topology& topology)
{
    Far::TopologyDescriptor words;
    words.numVertices = static_cast<int>(cage.points.size());
    words.numFaces = static_cast<int>(topology.sizes.size());
    words.numVertsPerFace = topology.sizes.data();
    words.vertIndicesPerFace = topology.corners.data();
    words.numCreases = static_cast<int>(topology.crease_sharpness.size());
    words.creaseVertexIndexPairs = topology.crease_points.data();
    words.creaseWeights = topology.crease_sharpness.data();
    words.numCorners = static_cast<int>(topology.tip_sharpness.size());
    words.cornerVertexIndices = topology.tips.data();
    words.cornerWeights = topology.tip_sharpness.data();
    words.numHoles = static_cast<int>(topology.holes.size());
    words.holeIndices = topology.holes.data();
    Sdc::Options rules;
    rules.SetVtxBoundaryInterpolation(cage.keep_boundary_corners ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER
                                                                 : Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(words, Factory::Options(Sdc::SCHEME_CATMARK, rules)));
}

Point point_of(const double* numbers)
{
    return {numbers[0], numbers[1], numbers[2]};
}

} // namespace

struct CageFaces::Surfaces {
    Surfaces(const SubdivisionCage& cage, const std::string& place) : topology(topology_of(cage))
    {
        refiner = refiner_of(cage, topology);
        if (!refiner)
            throw InputError{place, "the faces of the subdivision cage do not hang together as a surface",
                             "draw it as a plain mesh, or repair it in the program that made it"};
        Bfr::SurfaceFactory::Options options;
        options.SetApproxLevelSmooth(irregular_level);
        factory = std::make_unique<Bfr::RefinerSurfaceFactory<>>(*refiner, options);
        for (const Point& point : cage.points)
            numbers.insert(numbers.end(), {point.x, point.y, point.z});
    }

    Topology topology;
    std::unique_ptr<Far::TopologyRefiner> refiner;
    std::unique_ptr<Bfr::RefinerSurfaceFactory<>> factory;
    std::vector<double> numbers;
    Bfr::Surface<double> surface; ///< of the face that is asked
    std::vector<double> patch_numbers;

    void place_in_face(std::size_t patch, const FacePlace& at, double in_face[2]) const
    {
        const Bfr::Parameterization places = surface.GetParameterization();
        in_face[0] = at[0];
        in_face[1] = at[1];
        if (places.HasSubFaces())
            places.ConvertNormalizedSubFaceToCoord(static_cast<int>(patch), at.data(), in_face);
    }
};

CageFaces::CageFaces(const SubdivisionCage& cage, const std::string& place)
    : surfaces_(std::make_unique<Surfaces>(cage, place))
{
}

CageFaces::~CageFaces() = default;

std::size_t CageFaces::creases_left_out() const
{
    return surfaces_->topology.creases_left_out;
}

bool CageFaces::choose(std::size_t face)
{
    Surfaces& all = *surfaces_;
    if (!all.factory->InitVertexSurface(static_cast<int>(face), &all.surface))
        return false;
    all.patch_numbers.resize(static_cast<std::size_t>(all.surface.GetNumPatchPoints()) * numbers_per_point);
    all.surface.PreparePatchPoints(all.numbers.data(), numbers_per_point, all.patch_numbers.data(), numbers_per_point);
    return true;
}

Point CageFaces::point(std::size_t patch, const FacePlace& at) const
{
    double in_face[2], point[3];
    surfaces_->place_in_face(patch, at, in_face);
    surfaces_->surface.Evaluate(in_face, surfaces_->patch_numbers.data(), numbers_per_point, point);
    return point_of(point);
}

CageFaces::Sample CageFaces::sample(std::size_t patch, const FacePlace& at) const
{
    double in_face[2], point[3], along_u[3], along_v[3];
    surfaces_->place_in_face(patch, at, in_face);
    surfaces_->surface.Evaluate(in_face, surfaces_->patch_numbers.data(), numbers_per_point, point, along_u, along_v);
    return {point_of(point), point_of(along_u), point_of(along_v)};
}

} // namespace lightwell
