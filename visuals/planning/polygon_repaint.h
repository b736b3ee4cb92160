#pragma once

#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/sight.h"
#include "visuals/planning/step_writer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// Paints aircraft that no order puts right as wholes: boxes that meet each other or the ground.
/// It keeps its memory from frame to frame.
///
/// Polygon by polygon: after each polygon P everything painted before is painted once more, in its
/// order, as far as it lies in the cone of the eye over P and before the plane of P. If the picture
/// was right before P, it is right after: where nothing lies before P, P is seen; elsewhere what
/// was on top lies before P (the nearest does when any does) and comes on top again. Polygons of
/// the same aircraft are in order already and are not compared. What is painted again is cut to
/// a convex part of itself by planes through the eye.
class PolygonRepaint {
public:
    /// Paints the aircraft in `box` over ground that has been painted; `meeting` are the triangles
    /// that meet the box, in painting order, and only what lies inside it is painted again.
    /// `rounding_rad`: how far a renderer may move an edge. Returns how many triangles and polygons
    /// were painted again; nothing, with some of it written, where that would be more than
    /// `max_again` or more than `max_compared` pairs would have to be compared.
    std::optional<int> paint(
        std::span<const PlacedAircraft* const> aircraft,
        const HullBox& box,
        const GroundFrame& ground,
        std::span<const std::uint32_t> meeting,
        double rounding_rad,
        StepWriter& steps);

private:
    /// More take longer than a frame has: some hundred are usual where two aircraft meet.
    static constexpr int max_again = 1500;
    static constexpr std::size_t max_compared = 250'000;

    static constexpr std::uint32_t is_ground = ~std::uint32_t{0};

    /// Something painted: a part of a polygon or of a triangle.
    struct Painted {
        /// Index of the aircraft, or is_ground.
        std::uint32_t owner = is_ground;
        /// The number of the triangle; else the first index of the polygon.
        std::uint32_t item = 0;
        /// How many indices the polygon has; 0 for a triangle of the ground.
        std::uint32_t index_count = 0;
        /// Where the corners of its part begin in corners_.
        std::size_t first_corner = 0;
        std::size_t corner_count = 0;
    };

    bool is_too_much() const { return again_ > max_again || compared_ > max_compared; }

    void note(Painted painted, const SightPolygon& part);
    void paint_aircraft(
        std::span<const PlacedAircraft* const> aircraft,
        std::uint32_t owner,
        double rounding_rad,
        StepWriter& steps);
    void paint_range(
        std::span<const PlacedAircraft* const> aircraft,
        std::uint32_t owner,
        const scene::IndexRange& range,
        double rounding_rad,
        StepWriter& steps);
    void
    find_hiding(const Plane& plane, std::uint32_t owner, std::size_t before, double rounding_rad);
    void write(
        std::span<const PlacedAircraft* const> aircraft, const Painted& painted, StepWriter& steps);

    std::vector<Painted> painted_;
    std::vector<SightCorner> corners_;
    const GroundFrame* ground_ = nullptr;
    SightPolygon polygon_;
    SightPolygon part_;
    SightPolygon scratch_;
    std::vector<glm::dvec3> cone_;
    int again_ = 0;
    std::size_t compared_ = 0;
};

} // namespace octant::visuals::planning
