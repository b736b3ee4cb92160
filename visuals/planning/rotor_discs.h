#pragma once

#include "models/collapse_sequence.h"
#include "models/polygons/polygon_model.h"
#include "visuals/scene/frame_plan.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// A rotor or propeller that turns so fast that it is seen as a disc in place of its blades. Body axes, metres.
struct RotorDisc {
    /// The disc as it is seen from one side of its plane. A polygon of the blades faces that side at every angle, and
    /// the body that it sweeps holds the disc: in an order that holds at every angle the disc has that polygon's place.
    struct Side {
        std::uint32_t polygon = models::none; ///< none: no blade is seen from this side, where the disc is not drawn
        glm::dvec3 centre_m{0.0};
        double radius_m = 0.0;
    };

    /// Indices into PolygonModel::pivots of all that turn in this place, blade by blade perhaps; the first one's axis
    /// is the disc's.
    std::vector<std::uint32_t> pivots;
    double root_m = 0.0;           ///< the radius at which the disc begins; polygons that reach beyond it are blades
    std::array<Side, 2> sides;     ///< seen from the side to which the axis points, and from the other one
    scene::IndexRange blades = {}; ///< of AircraftModel::turning; empty on models without it
};

struct RotorDiscs {
    std::vector<RotorDisc> discs;
    /// For each polygon the index of the disc whose blade it is, models::none for the others; empty without discs.
    std::vector<std::uint32_t> disc_of_polygon;
};

/// The discs of what turns fast in a model. Parts that cover most of the circle that they sweep have none. Loading
/// work.
RotorDiscs find_discs(const models::polygons::PolygonModel& model);

/// What covers the circle that a rotor sweeps, seen along its axis.
class DiscCoverage {
public:
    /// `axis` must outlive it. Body axes, metres.
    DiscCoverage(const models::polygons::Pivot& axis, double radius_m);

    /// Adds a convex polygon, body axes.
    void add(std::span<const glm::dvec3> corners_m);

    /// The radius of a hub: of what covers most of each circle about the axis, and its corners; 0 without one. Nothing
    /// where most of the disc is covered, or that radius is not smaller than the disc's.
    std::optional<double> hub_radius_m() const;

private:
    static constexpr std::size_t circles = 40;
    static constexpr std::size_t directions = 64;

    bool holds(const glm::dvec2& place_m, double twice_area_m2) const;

    const models::polygons::Pivot& axis_;
    double radius_m_;
    glm::dvec3 right_ = glm::normalize(
        glm::cross(axis_.axis, std::abs(axis_.axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    glm::dvec3 up_ = glm::cross(axis_.axis, right_);
    std::array<glm::dvec2, directions> ways_{};
    std::vector<glm::dvec2> flat_;
    std::array<std::array<bool, directions>, circles> covered_{};
};

} // namespace octant::visuals::planning
