#pragma once

#include "visuals/landscape/ground_mesher.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/fleet.h"
#include "visuals/planning/frame_transparents.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/smooth_choice.h"
#include "visuals/planning/step_writer.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::planning {

/// Aircraft that are painted as one: nearly always a single one.
struct OverlapGroup {
    /// The box of a single member; else it holds the boxes of all, and may meet other knots.
    OrientedBox box;
    std::uint32_t first = 0;
    /// Its members are first to first + count - 1.
    std::uint32_t count = 0;
};

/// Painting order of aircraft by the boxes that stand in for them. Keeps its memory.
///
/// A box must wait for every other of which it can hide a part; two that meet wait for each other. Boxes that wait for
/// each other, directly or in a ring, become one knot, and no others do: what is left has an order.
///
/// Nearly all of it comes from a sort. The power of the eye with respect to a sphere is
/// |centre|^2 - radius^2. The eyes of equal power to two spheres that do not meet form a plane
/// between them, and the sphere on the eye's side has the smaller power: by descending power, no such box comes before
/// one that must be painted first. Only where spheres meet, a box may come before one that it hides; the window of the
/// list from one to the other is then sorted anew by which box hides which. No ring reaches out of these windows.
class SceneOrder {
public:
    /// Boxes with the eye at the origin.
    void arrange(std::span<const OrientedBox> boxes);

    /// Farthest first: no member of a knot hides any part of a member of a later one from the eye.
    std::span<const OverlapGroup> overlap_groups() const { return overlap_groups_; }

    /// Boxes of a knot, by index, ascending.
    std::span<const std::uint32_t> members(const OverlapGroup& overlap_group) const {
        return std::span(members_).subspan(overlap_group.first, overlap_group.count);
    }

private:
    struct Body {
        OrientedBox box;
        double radius_m = 0.0;
        double power_m2 = 0.0;
        /// A unit vector.
        glm::dvec3 towards{0.0};
        /// Of half the angle over which the sphere is seen.
        double sine = 0.0;
        double cosine = 0.0;
        /// Whether the sphere holds the eye.
        bool around_eye = false;
        /// The index of the box.
        std::uint32_t index = 0;
    };

    /// Where the search for rings has come with a body of a window.
    struct ComponentVisit {
        /// In order of first visits, from 1; 0 = not yet seen.
        std::uint32_t number = 0;
        /// The least number known to be reached from here.
        std::uint32_t least = 0;
        /// A place in occluders_.
        std::uint32_t next = 0;
        std::uint32_t end = 0;
        bool is_in_group = false;
    };

    static bool may_overlap_on_screen(const Body& a, const Body& b);

    void place_bodies(std::span<const OrientedBox> boxes);
    void find_windows();
    void arrange_window(std::uint32_t first, std::uint32_t last);
    void find_occluders(std::uint32_t first, std::uint32_t count);
    void visit_component(std::uint32_t first, std::uint32_t body);
    void begin_visit(std::uint32_t body);
    void add_overlap_group(std::span<const std::uint32_t> bodies, std::uint32_t first);

    /// By descending power.
    std::vector<Body> bodies_;
    std::vector<std::uint32_t> by_x_;
    /// The first and the last body of each.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> windows_;
    /// A body, and one that it waits for.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> occluders_;
    std::vector<ComponentVisit> visits_;
    /// Bodies of which each waits for the next.
    std::vector<std::uint32_t> path_;
    /// Bodies that were seen and are not yet in a knot, by number.
    std::vector<std::uint32_t> open_;
    std::uint32_t visited_ = 0;
    std::vector<OverlapGroup> overlap_groups_;
    std::vector<std::uint32_t> members_;
};

/// Paints aircraft that no order puts right as wholes: boxes that meet each other or the ground. It keeps its memory
/// from frame to frame.
///
/// Polygon by polygon: after each polygon P everything painted before is painted once more, in its order, as far as it
/// lies in the cone of the eye over P and before the plane of P. If the picture was right before P, it is right after:
/// where nothing lies before P, P is seen; elsewhere what was on top lies before P (the nearest does when any does) and
/// comes on top again. Polygons of the same aircraft are in order already and are not compared. What is painted again
/// is cut to a convex part of itself by planes through the eye.
class PolygonRepaint {
public:
    /// Paints the aircraft in `box` over ground that has been painted; `intersecting` are the triangles that meet the
    /// box, in painting order, and only what lies inside it is painted again. `rounding_rad`: how far a renderer may
    /// move an edge. Returns how many triangles and polygons were painted again; nothing, with some of it written,
    /// where that would be more than `max_repaints` or more than `max_comparisons` pairs would have to be compared.
    std::optional<int> paint(std::span<const PlacedAircraft* const> aircraft, const OrientedBox& box,
        const GroundFrame& ground, std::span<const std::uint32_t> intersecting, double rounding_rad, StepWriter& steps);

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
        std::span<const PlacedAircraft* const> aircraft, std::uint32_t owner, double rounding_rad, StepWriter& steps);
    void paint_range(std::span<const PlacedAircraft* const> aircraft, std::uint32_t owner,
        const scene::IndexRange& range, double rounding_rad, StepWriter& steps);
    void find_occluding(const Plane& plane, std::uint32_t owner, std::size_t before, double rounding_rad);
    void write(std::span<const PlacedAircraft* const> aircraft, const PaintedItem& painted, StepWriter& steps);

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

/// The pixels that hold a box as FramePlan::world_to_view and view_to_clip show it; the whole picture where part of the
/// box lies behind the eye.
scene::PixelBox pixel_box(const OrientedBox& box, const scene::FramePlan& plan, const glm::ivec2& size_px);

/// All that is in a frame, apart from the order in which it is painted.
struct FrameScene {
    const FrameView& view;
    const Fleet& fleet;
    const SmoothChoice& smooth;
    const FrameTransparents& transparents;
    const GroundFrame& ground;
    /// The mesher of `ground`, which finds its triangles again.
    const landscape::GroundMesher& mesher;
};

/// Writes the painting steps of a plan: in which order, and how, what is in a frame is drawn. It also chooses which
/// triangles of the ground the plan draws. Keeps its memory.
///
/// In painting order (HiddenSurface::Octant, BackFace): sky, ground with its shadows in place, then the aircraft from
/// far to near. Clouds come before what lies on the eye's side of them and after the rest: seen from below before all
/// ground, seen from above after it. After each knot of aircraft the ground that lies before it is painted again, cut
/// to where the knot is seen. Meshes ask for depth, within their knot, and so do aircraft that meet in too many places.
///
/// By depth (HiddenSurface::DepthBuffer): from near to far, so that what is hidden is not coloured first: aircraft,
/// ground, shadows, sky. Where aircraft and ground are equally near the aircraft is seen.
class ScenePainter {
public:
    /// The plan must outlive it; its lists of steps, clips and draws are empty before each frame.
    explicit ScenePainter(scene::FramePlan& plan) : plan_(plan), steps_(plan) {}

    /// Adds what was painted again, and in knots, to the counts.
    void paint(const FrameScene& frame, scene::HiddenSurface hidden_surface, PlanCounts& counts);

private:
    void paint_by_depth(const FrameScene& frame);
    void paint_in_order(const FrameScene& frame, PlanCounts& counts);
    void paint_groups(const FrameScene& frame, bool beyond_clouds, PlanCounts& counts);
    void paint_group(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts);
    void collect_members(const FrameScene& frame, const OverlapGroup& overlap_group);
    void paint_with_effects(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts);
    void paint_members(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts);
    void paint_intersecting(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts);
    void paint_members_by_depth(const FrameScene& frame, const OverlapGroup& overlap_group);
    void paint_effects(const FrameScene& frame, bool after);
    void paint_dashes(const FrameScene& frame, double farther_m2, double nearer_m2);
    void paint(const FrameScene& frame, const PlacedAircraft& aircraft, scene::DepthUse depth);
    void paint_transparent(const FrameScene& frame, const PlacedAircraft& aircraft);

    scene::FramePlan& plan_;
    StepWriter steps_;
    SceneOrder order_;
    GroundInFront in_front_;
    PolygonRepaint repaint_;
    /// The boxes that have a place in the painting order: those of the aircraft, then those of the ribbon's dashes.
    std::vector<OrientedBox> boxes_;
    /// The aircraft of the knot that is painted, and its dashes, by their boxes.
    std::vector<const PlacedAircraft*> members_;
    std::vector<std::uint32_t> group_dashes_;
    std::vector<std::uint32_t> near_to_far_;
    std::vector<std::uint32_t> facing_indices_;
};

} // namespace octant::visuals::planning
