#pragma once

#include "plugins/validation/rectangle_factors.h"
#include "plugins/validation/room_frame.h"

#include <array>
#include <optional>
#include <vector>

namespace lightwell {

/// An empty diffuse room, as a radiosity calculation has it.
struct RadiosityRoom {
    Point size;
    std::array<double, 6> reflectance{}; ///< floor, ceiling, x0, x1, y0, y1
    /// A black rectangle in the ceiling that shines down.
    struct Panel {
        double x0, x1, y0, y1, exitance;
    };
    std::optional<Panel> panel = {};
    /// A sheet across the room, from wall to wall.
    struct Partition {
        double y, height, reflectance_y0, reflectance_y1;
    };
    std::optional<Partition> partition = {};
    /// A point that shines all around; only in rooms without a partition.
    struct Lamp {
        Point position;
        double flux_lm;
    };
    std::optional<Lamp> lamp = {};
};

/// Illuminance with all interreflection: rectangles that grow smaller towards the edges, of constant radiosity, with
/// exact factors between them and from places to them; what the partition hides is found by quadrature.
/// Error: falls with the square of the number of cells (see ExtrapolatedRadiosity)
/// Source  Lambert 1760; Goral et al. 1984 (radiosity)
class BoxRadiosity {
public:
    /// @param cells  along each edge
    BoxRadiosity(const RadiosityRoom& room, int cells);
    double at(const Point& place, const Direction& normal) const;
    /// Mean over a face by its name: those of room_faces, part_y0side, part_y1side.
    double mean(const std::string& face) const;

private:
    struct Patch {
        std::size_t face;
        std::vector<Point> corners;
        Point middle;
        Direction normal;
        double area, reflectance, own;
        double illuminance = 0, radiosity = 0;

        AxisRectangle rectangle() const;
        Point at(double u, double v) const; ///< u and v in [0, 1]
        Patch part(int i, int k, int parts) const;
    };
    struct Face {
        RoomFace frame;
        double reflectance;
        std::vector<double> u_breaks, v_breaks; ///< where cells end, beside 0 and 1
    };
    void add_faces();
    void add_patches(std::size_t face, int cells);
    void solve();
    std::vector<double> exchange() const;
    void close(std::vector<double>& flux) const;
    double mean_hidden(const Patch& patch, const Patch& other) const;
    double gathered(const Point& place, const Direction& normal) const;
    double direct(const Point& place, const Direction& normal) const;
    double mean_direct(const Patch& patch) const;
    double factor(const Point& place, const Direction& normal, const Patch& patch) const;
    double hidden_factor(const Point& place, const Direction& normal, const Patch& patch) const;

    RadiosityRoom room_;
    std::vector<Face> faces_;
    std::vector<Patch> patches_;
};

/// Two meshes, and what the step from one to the other says of a mesh without end.
/// Error: 2e-3 relative at places 0.1 m and more from an edge (tests/unit/validation)
class ExtrapolatedRadiosity {
public:
    explicit ExtrapolatedRadiosity(const RadiosityRoom& room) : coarse_(room, coarse_cells), fine_(room, fine_cells) {}
    double at(const Point& place, const Direction& normal) const
    {
        return without_end(coarse_.at(place, normal), fine_.at(place, normal));
    }
    double mean(const std::string& face) const { return without_end(coarse_.mean(face), fine_.mean(face)); }

private:
    static constexpr int coarse_cells = 8, fine_cells = 12;
    static double without_end(double coarse, double fine)
    {
        constexpr double ratio = static_cast<double>(fine_cells) / coarse_cells;
        return fine + (fine - coarse) / (ratio * ratio - 1);
    }
    BoxRadiosity coarse_, fine_;
};

} // namespace lightwell
