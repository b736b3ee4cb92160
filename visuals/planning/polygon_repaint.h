#pragma once

#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/view_polygon.h"
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
    /// Paints the aircraft in `box` over ground that has been painted; `intersecting` are the triangles
    /// that meet the box, in painting order, and only what lies inside it is painted again.
    /// `rounding_rad`: how far a renderer may move an edge. Returns how many triangles and polygons
    /// were painted again; nothing, with some of it written, where that would be more than
    /// `max_repaints` or more than `max_comparisons` pairs would have to be compared.
    std::optional<int> paint(
        std::span<const PlacedAircraft* const> aircraft,
        const OrientedBox& box,
        const GroundFrame& ground,
        std::span<const std::uint32_t> intersecting,
        double rounding_rad,
        StepWriter& steps);

private:
    /// More take longer than a frame has: some hundred are usual where two aircraft meet.
    static constexpr int max_repaints = 1500;
    static constexpr std::size_t max_comparisons = 250'000;

    static constexpr std::uint32_t is_ground = ~std::uint32_t{0};

    /// Something painted: a part of a polygon or of a triangle.
    struct PaintedItem {
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

    bool exceeds_limits() const { return repaint_count_ > max_repaints || comparison_count_ > max_comparisons; }

    void record(PaintedItem painted, const ViewPolygon& part);
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
    find_occluding(const Plane& plane, std::uint32_t owner, std::size_t before, double rounding_rad);
    void write(
        std::span<const PlacedAircraft* const> aircraft, const PaintedItem& painted, StepWriter& steps);

    std::vector<PaintedItem> painted_;
    std::vector<ViewVertex> corners_;
    const GroundFrame* ground_ = nullptr;
    ViewPolygon polygon_;
    ViewPolygon part_;
    ViewPolygon scratch_;
    std::vector<glm::dvec3> cone_;
    int repaint_count_ = 0;
    std::size_t comparison_count_ = 0;
};

} // namespace octant::visuals::planning
