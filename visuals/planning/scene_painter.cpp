#include "visuals/planning/scene_painter.h"

#include "visuals/planning/bounding_box.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/scene_order.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::planning {

namespace {

/// The unit normal of the plane through the eye and an edge, with `inside_m` in front; zero for an edge seen end-on.
glm::dvec3 edge_normal(const glm::dvec3& from_m, const glm::dvec3& to_m, const glm::dvec3& inside_m) {
    const glm::dvec3 across = glm::cross(from_m, to_m);
    const double size = glm::length(across);
    if (size <= 1e-14 * glm::length(from_m) * glm::length(to_m)) { return glm::dvec3(0.0); }
    return across * ((glm::dot(across, inside_m) < 0.0 ? -1.0 : 1.0) / size);
}

} // namespace

/// Appends painting steps to a plan. Functions that add a list or a range do nothing if it is empty.
class StepWriter {
public:
    explicit StepWriter(scene::FramePlan& plan) : plan_(plan) {}

    /// A state of the plan to which roll_back() returns.
    struct Checkpoint {
        std::size_t steps = 0;
        std::size_t last_count = 0; ///< PaintStep::count of the last step, to which more may be added.
        std::size_t aircraft = 0;
        std::size_t clips = 0;
        std::size_t repaint_indices = 0;
    };

    Checkpoint checkpoint() const {
        return {plan_.steps.size(), plan_.steps.empty() ? 0 : plan_.steps.back().count, plan_.aircraft.size(),
            plan_.clips.size(), plan_.repaint_indices.size()};
    }

    /// Removes the aircraft, the ground and the clips that were added since.
    void roll_back(const Checkpoint& checkpoint) {
        plan_.steps.resize(checkpoint.steps);
        if (checkpoint.steps > 0) { plan_.steps.back().count = static_cast<std::uint32_t>(checkpoint.last_count); }
        plan_.aircraft.resize(checkpoint.aircraft);
        plan_.clips.resize(checkpoint.clips);
        plan_.repaint_indices.resize(checkpoint.repaint_indices);
    }

    /// Clears the depth in a box: draws by depth from here on hide each other only.
    void clear_depth(const scene::PixelBox& box) {
        const auto place = static_cast<std::uint32_t>(plan_.depth_boxes.size());
        plan_.depth_boxes.push_back(box);
        plan_.steps.push_back({scene::PaintStep::Content::ClearDepth, place, 1});
    }

    /// Adds the plan's sky.
    void add_sky(scene::DepthUse depth = scene::DepthUse::None) {
        add_range(scene::PaintStep::Content::Sky, 0, plan_.sky.indices.size(), depth);
    }

    /// Adds the plan's ground in its order.
    void add_ground() {
        add_range(scene::PaintStep::Content::Ground, 0, plan_.ground.indices.size(), scene::DepthUse::None);
    }

    /// Adds the plan's ground by depth. The last `edge_on_indices` indices are of triangles that face the eye by
    /// rounding only: they close holes along edges, and their depths are meaningless elsewhere.
    void add_ground_by_depth(std::size_t edge_on_indices) {
        const std::size_t facing = plan_.ground.indices.size() - edge_on_indices;
        add_range(scene::PaintStep::Content::Ground, 0, facing, scene::DepthUse::Nearest);
        add_range(scene::PaintStep::Content::Ground, facing, edge_on_indices, scene::DepthUse::EdgeOn);
    }

    /// Adds all pieces on ground that was drawn by depth.
    void add_shadows_by_depth(const GroundFrame& ground) {
        const std::size_t first = plan_.repaint_indices.size();
        const auto pieces = ground.piece_indices;
        plan_.repaint_indices.insert(plan_.repaint_indices.end(), pieces.begin(), pieces.end());
        add_range(scene::PaintStep::Content::GroundRepaint, first, pieces.size(), scene::DepthUse::OnGround);
    }

    /// Adds a range of the plan's overlay as transparent things.
    void add_transparent(const TransparentRange& range, scene::DepthUse depth) {
        add_range(scene::PaintStep::Content::Transparent, range.first, range.count, depth);
    }

    /// Adds the plan's overlay from an index on.
    void add_overlay(std::size_t first) {
        add_range(
            scene::PaintStep::Content::Overlay, first, plan_.overlay.indices.size() - first, scene::DepthUse::None);
    }

    /// Adds an aircraft or a part of it. Opaque ones that follow one another and are drawn in the same way become one
    /// step. `opacity`: PaintStep::opacity.
    void add(const scene::AircraftDraw& draw, scene::DepthUse depth = scene::DepthUse::None, float opacity = 1.0F) {
        const auto place = static_cast<std::uint32_t>(plan_.aircraft.size());
        plan_.aircraft.push_back(draw);
        if (!plan_.steps.empty() && opacity == 1.0F) {
            scene::PaintStep& last = plan_.steps.back();
            if (last.content == scene::PaintStep::Content::Aircraft && last.clip == scene::PaintStep::no_clip &&
                last.depth == depth && last.opacity == 1.0F && last.first + last.count == place) {
                ++last.count;
                return;
            }
        }
        plan_.steps.push_back(
            {scene::PaintStep::Content::Aircraft, place, 1, scene::PaintStep::no_clip, depth, opacity});
    }

    /// Adds a refined mesh, by depth.
    void add(const scene::RefinedDraw& draw) {
        const auto place = static_cast<std::uint32_t>(plan_.refined.size());
        plan_.refined.push_back(draw);
        plan_.steps.push_back(
            {scene::PaintStep::Content::Refined, place, 1, scene::PaintStep::no_clip, scene::DepthUse::Nearest});
    }

    /// Paints a polygon of an aircraft again inside `region`, a part of it.
    void add_within(const scene::AircraftDraw& draw, const ViewPolygon& region) {
        const auto place = static_cast<std::uint32_t>(plan_.aircraft.size());
        plan_.aircraft.push_back(draw);
        for_each_clip(region, [&](std::uint32_t clip) {
            plan_.steps.push_back({scene::PaintStep::Content::Aircraft, place, 1, clip});
        });
    }

    /// Paints triangles, with their pieces, again in front of a box and inside `cone`, which is that of the box or of
    /// one inside it. `triangles` are in painting order; those that intersect the box are clipped to the outside of its
    /// sides. The eye must be outside the box.
    void add_in_front(const GroundFrame& ground, std::span<const GroundInFrontTriangle> triangles,
        const OrientedBox& box, const ViewCone& cone) {
        std::uint32_t cone_clip = scene::PaintStep::no_clip;
        bool continues = false; // The last step has the cone as its only clip: more can be added to it.
        for (const GroundInFrontTriangle& near : triangles) {
            if (near.intersects) {
                add_outside(ground, near.triangle, box, cone);
                continues = false;
                continue;
            }
            const auto first = static_cast<std::uint32_t>(plan_.repaint_indices.size());
            add_indices(ground, near.triangle);
            const auto count = static_cast<std::uint32_t>(plan_.repaint_indices.size()) - first;
            if (continues) {
                plan_.steps.back().count += count;
                continue;
            }
            cone_clip = cone_clip == scene::PaintStep::no_clip ? add_clip(cone.planes()) : cone_clip;
            plan_.steps.push_back({scene::PaintStep::Content::GroundRepaint, first, count, cone_clip});
            continues = true;
        }
    }

    /// Paints a triangle with its pieces again inside `region`, a part of it.
    void add_within(const GroundFrame& ground, std::uint32_t triangle, const ViewPolygon& region) {
        const auto first = static_cast<std::uint32_t>(plan_.repaint_indices.size());
        add_indices(ground, triangle);
        const auto count = static_cast<std::uint32_t>(plan_.repaint_indices.size()) - first;
        for_each_clip(region, [&](std::uint32_t clip) {
            plan_.steps.push_back({scene::PaintStep::Content::GroundRepaint, first, count, clip});
        });
    }

    /// Writes the depth of painted triangles that intersect the next draws by depth.
    void occlude_by_ground(const GroundFrame& ground, std::span<const std::uint32_t> triangles) {
        const auto first = static_cast<std::uint32_t>(plan_.repaint_indices.size());
        for (const std::uint32_t triangle : triangles) {
            const auto own = ground.all.indices.subspan(std::size_t{3} * triangle, 3);
            plan_.repaint_indices.insert(plan_.repaint_indices.end(), own.begin(), own.end());
        }
        const auto count = static_cast<std::uint32_t>(3 * triangles.size());
        plan_.steps.push_back({scene::PaintStep::Content::GroundRepaint, first, count, scene::PaintStep::no_clip,
            scene::DepthUse::DepthOnly});
    }

private:
    void add_range(scene::PaintStep::Content content, std::size_t first, std::size_t count, scene::DepthUse depth) {
        if (count > 0) {
            plan_.steps.push_back({content, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                scene::PaintStep::no_clip, depth});
        }
    }

    /// Returns the index of a new clip by planes through the eye, at most Clip::max_planes.
    std::uint32_t add_clip(std::span<const glm::dvec3> normals) {
        assert(normals.size() <= std::size_t{scene::Clip::max_planes});
        scene::Clip& clip = plan_.clips.emplace_back();
        for (const glm::dvec3& normal : normals) {
            clip.planes[static_cast<std::size_t>(clip.count++)] = glm::vec4(glm::vec3(normal), 0.0F);
        }
        return static_cast<std::uint32_t>(plan_.clips.size() - 1);
    }

    /// Paints a triangle again in front of a box. A line of sight enters the box through the last of the sides that
    /// face the eye; therefore a point in the cone is in front of the box if it is outside any of these sides.
    void add_outside(const GroundFrame& ground, std::uint32_t triangle, const OrientedBox& box, const ViewCone& cone) {
        const auto first = static_cast<std::uint32_t>(plan_.repaint_indices.size());
        std::uint32_t count = 0;
        for (int side = 0; side < 6; ++side) {
            const Plane plane = side_of(box, side);
            if (plane.offset_m <= 0.0) { continue; }
            place_triangle(ground.all, triangle, piece_);
            clip_to_front(piece_, plane, 0.0, scratch_);
            clip_to_cone(piece_, cone.planes(), scratch_);
            if (solid_angle_sr(piece_) < min_solid_angle_sr) { continue; }
            if (count == 0) {
                add_indices(ground, triangle);
                count = static_cast<std::uint32_t>(plan_.repaint_indices.size()) - first;
            }
            const std::uint32_t index = add_clip(cone.planes());
            scene::Clip& clip = plan_.clips[index];
            clip.planes[static_cast<std::size_t>(clip.count++)] =
                glm::vec4(glm::vec3(plane.normal), static_cast<float>(plane.offset_m));
            plan_.steps.push_back({scene::PaintStep::Content::GroundRepaint, first, count, index});
        }
    }

    void add_indices(const GroundFrame& ground, std::uint32_t triangle) {
        const auto own = ground.all.indices.subspan(std::size_t{3} * triangle, 3);
        plan_.repaint_indices.insert(plan_.repaint_indices.end(), own.begin(), own.end());
        for (const PieceRange& shadow : pieces_on(ground, triangle)) {
            const auto pieces = ground.piece_indices.subspan(shadow.first, shadow.count);
            plan_.repaint_indices.insert(plan_.repaint_indices.end(), pieces.begin(), pieces.end());
        }
    }

    /// Calls paint(clip) for convex parts of `region`, each with at most Clip::max_planes planes.
    template <class Paint>
    void for_each_clip(const ViewPolygon& region, const Paint& paint) {
        constexpr std::size_t max_planes = scene::Clip::max_planes;
        const auto cuts = static_cast<std::size_t>(
            std::ranges::count_if(region, [](const ViewVertex& corner) { return corner.cut; }));
        const auto add_edges = [&](const ViewPolygon& piece, bool all) {
            normals_.clear();
            const glm::dvec3 middle_m = middle_of(piece);
            for (std::size_t i = 0; i < piece.size(); ++i) {
                const glm::dvec3 normal =
                    edge_normal(piece[i].at_m, piece[i + 1 < piece.size() ? i + 1 : 0].at_m, middle_m);
                if ((all || piece[i].cut) && normal != glm::dvec3(0.0)) { normals_.push_back(normal); }
            }
            paint(add_clip(normals_));
        };
        if (cuts <= max_planes) {
            add_edges(region, false);
            return;
        }
        // A fan of parts with few edges each.
        for (std::size_t from = 1; from + 1 < region.size(); from += max_planes - 2) {
            const std::size_t to = std::min(from + max_planes - 2, region.size() - 1);
            piece_.assign(1, region[0]);
            for (std::size_t i = from; i <= to; ++i) { piece_.push_back(region[i]); }
            add_edges(piece_, true);
        }
    }

    scene::FramePlan& plan_;
    ViewPolygon piece_;
    ViewPolygon scratch_;
    std::vector<glm::dvec3> normals_;
};

namespace {

/// A corner within this share of its distance from another polygon's plane counts as on the plane.
constexpr double touching = 1e-9;

} // namespace

/// Paints aircraft that cannot be ordered as a whole, because their boxes intersect each other or the ground.
///
/// It paints polygon by polygon. After each polygon P, the parts of all earlier polygons and triangles that are inside
/// the eye's cone over P and in front of P's plane are painted again, in their order, clipped by planes through the
/// eye. If the picture was right before P, it is right after: at a point with nothing in front of P, P is visible; at
/// others the visible surface is in front of P (the nearest one is, if any is) and is painted again. Polygons of the
/// same aircraft are in order already and are not compared.
class PolygonRepaint {
public:
    /// Paints the aircraft in `box` over ground that has been painted. `intersecting`: the triangles that intersect the
    /// box, in painting order; only their parts inside it are painted again. `rounding_rad`: the angle by which a
    /// renderer may move an edge. Returns the number of triangles and polygons that were painted again; nothing, with a
    /// part of the steps written, if that exceeds `max_repaints` or the compared pairs exceed `max_comparisons`.
    std::optional<int> paint(std::span<const PlacedAircraft* const> aircraft, const OrientedBox& box,
        const GroundFrame& ground, std::span<const std::uint32_t> intersecting, double rounding_rad,
        StepWriter& steps) {
        painted_.clear();
        corners_.clear();
        repaint_count_ = 0;
        comparison_count_ = 0;
        ground_ = &ground;
        for (const std::uint32_t triangle : intersecting) {
            place_triangle(ground.all, triangle, part_);
            clip_to_box(part_, box, scratch_);
            record({is_ground, triangle, 0, 0, 0}, part_);
        }
        for (std::uint32_t owner = 0; owner < aircraft.size() && !exceeds_limits(); ++owner) {
            paint_aircraft(aircraft, owner, rounding_rad, steps);
        }
        return exceeds_limits() ? std::nullopt : std::optional(repaint_count_);
    }

private:
    /// More would take longer than a frame; some hundred are usual where two aircraft intersect.
    static constexpr int max_repaints = 1500;
    static constexpr std::size_t max_comparisons = 250'000;

    static constexpr std::uint32_t is_ground = ~std::uint32_t{0};

    /// A painted part of a polygon or of a triangle.
    struct PaintedItem {
        /// Index of the aircraft, or is_ground.
        std::uint32_t owner = is_ground;
        /// The number of the triangle, or the first index of the polygon.
        std::uint32_t item = 0;
        /// The number of indices of the polygon; 0 for a triangle of the ground.
        std::uint32_t index_count = 0;
        /// The index in corners_ of the first corner of its part.
        std::size_t first_corner = 0;
        std::size_t corner_count = 0;
    };

    bool exceeds_limits() const { return repaint_count_ > max_repaints || comparison_count_ > max_comparisons; }

    void record(PaintedItem painted, const ViewPolygon& part) {
        painted.first_corner = corners_.size();
        painted.corner_count = part.size();
        corners_.insert(corners_.end(), part.begin(), part.end());
        painted_.push_back(painted);
    }

    void paint_aircraft(
        std::span<const PlacedAircraft* const> aircraft, std::uint32_t owner, double rounding_rad, StepWriter& steps) {
        for (const scene::IndexRange& range : aircraft[owner]->ranges) {
            paint_range(aircraft, owner, range, rounding_rad, steps);
        }
    }

    void paint_range(std::span<const PlacedAircraft* const> aircraft, std::uint32_t owner,
        const scene::IndexRange& range, double rounding_rad, StepWriter& steps) {
        const PlacedAircraft& own = *aircraft[owner];
        std::uint32_t run_first = range.first_index;
        std::uint32_t next = run_first;
        const auto polygons = own.list.subspan(range.first_polygon, static_cast<std::size_t>(range.polygons));
        for (const std::uint32_t polygon : polygons) {
            if (exceeds_limits()) { return; }
            const std::uint32_t first = next;
            next += own.model->index_count_of(polygon);
            place_polygon(own, polygon, polygon_);
            const Plane plane = plane_of(polygon_);
            if (plane.offset_m <= 0.0) {
                continue; // It faces away: not drawn.
            }
            const std::size_t before = painted_.size();
            record({owner, first, next - first, 0, 0}, polygon_);
            const std::size_t hiding = painted_.size();
            find_occluding(plane, owner, before, rounding_rad);
            if (painted_.size() == hiding) { continue; }
            steps.add(draw_of(own, run_first, next - run_first));
            run_first = next;
            for (std::size_t i = hiding; i < painted_.size(); ++i) {
                write(aircraft, painted_[i], steps);
                ++repaint_count_;
            }
        }
        if (next > run_first) { steps.add(draw_of(own, run_first, next - run_first)); }
    }

    /// Records the parts of earlier items that hide a part of polygon_.
    void find_occluding(const Plane& plane, std::uint32_t owner, std::size_t before, double rounding_rad) {
        cone_of(polygon_, rounding_rad, cone_);
        const double tolerance_m = touching * (1.0 + glm::length(middle_of(polygon_)));
        comparison_count_ += before;
        for (std::size_t i = 0; i < before; ++i) {
            const PaintedItem painted = painted_[i];
            if (painted.owner == owner) { continue; }
            const auto corners = std::span(corners_).subspan(painted.first_corner, painted.corner_count);
            part_.assign(corners.begin(), corners.end());
            clip_to_front(part_, plane, tolerance_m, scratch_);
            clip_to_cone(part_, cone_, scratch_);
            if (solid_angle_sr(part_) < min_solid_angle_sr) { continue; }
            record(painted, part_);
        }
    }

    void write(std::span<const PlacedAircraft* const> aircraft, const PaintedItem& painted, StepWriter& steps) {
        const auto corners = std::span(corners_).subspan(painted.first_corner, painted.corner_count);
        part_.assign(corners.begin(), corners.end());
        if (painted.owner == is_ground) {
            steps.add_within(*ground_, painted.item, part_);
        } else {
            steps.add_within(draw_of(*aircraft[painted.owner], painted.item, painted.index_count), part_);
        }
    }

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

namespace {

/// A little more than two rounding steps of renderers (1/256 pixel). Clips are wider by this, so that no line of the
/// covered polygon shows along a clip.
constexpr double paint_rounding_px = 0.01;

/// The pixels around a box in the picture of FramePlan::world_to_view and view_to_clip; the whole picture if a part of
/// the box is behind the eye.
scene::PixelBox pixel_box(const OrientedBox& box, const scene::FramePlan& plan, const glm::ivec2& size_px) {
    const glm::dmat4 world_to_clip = glm::dmat4(plan.view_to_clip) * glm::dmat4(plan.world_to_view);
    const glm::dvec2 size(size_px);
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& corner_m : corners_of(box)) {
        const glm::dvec4 clip = world_to_clip * glm::dvec4(corner_m, 1.0);
        constexpr double nearest = 1e-6; // The smallest distance in front of the eye, as a share of the box's size.
        if (clip.w <= nearest * radius_m(box)) { return {glm::ivec2(0), size_px}; }
        const glm::dvec2 at = glm::dvec2(clip.x, -clip.y) / clip.w;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const auto in_pixels = [&](const glm::dvec2& at) { return (at * 0.5 + 0.5) * size; };
    const glm::dvec2 from = glm::clamp(glm::floor(in_pixels(low)), glm::dvec2(0.0), size);
    const glm::dvec2 to = glm::clamp(glm::ceil(in_pixels(high)), glm::dvec2(0.0), size);
    return {glm::ivec2(from), glm::ivec2(to)};
}

double away_m2(const OrientedBox& box) { return glm::dot(box.centre_m, box.centre_m); }

/// Whether the middle of one box is nearer to the eye than that of another; of two that are equally far the one with
/// the lower number counts as nearer.
bool is_nearer(std::span<const OrientedBox> boxes, std::uint32_t a, std::uint32_t b) {
    const double a_m2 = away_m2(boxes[a]);
    const double b_m2 = away_m2(boxes[b]);
    return a_m2 != b_m2 ? a_m2 < b_m2 : a < b;
}

} // namespace

class ScenePainter::Painter {
public:
    explicit Painter(scene::FramePlan& plan) : plan_(plan), steps_(plan) {}

    void paint(const FrameScene& frame, scene::HiddenSurface hidden_surface, PlanCounts& counts) {
        frame_ = &frame;
        counts_ = &counts;
        hulls_ = frame.fleet.bounding_boxes();
        if (hidden_surface == scene::HiddenSurface::DepthBuffer) {
            paint_by_depth();
        } else {
            paint_in_order();
        }
        steps_.add_overlay(frame.transparents.draw().indices.size());
    }

private:
    void paint_by_depth() {
        const auto placed = frame_->fleet.placed();
        near_to_far_.resize(hulls_.size());
        std::iota(near_to_far_.begin(), near_to_far_.end(), 0U);
        std::ranges::sort(near_to_far_, [&](std::uint32_t a, std::uint32_t b) { return is_nearer(hulls_, a, b); });
        steps_.clear_depth({glm::ivec2(0), frame_->view.size_px});
        if (const PlacedAircraft* cockpit = frame_->fleet.cockpit()) { paint(*cockpit, scene::DepthUse::Nearest); }
        // Refined meshes come last, so that all other aircraft become one step.
        for (const bool refined : {false, true}) {
            for (const std::uint32_t i : near_to_far_) {
                if (is_refined(placed[i]) == refined && !placed[i].is_absent) {
                    paint(placed[i], scene::DepthUse::Nearest);
                }
            }
        }
        std::size_t edge_on_indices = 0;
        plan_.ground = front_facing_first(frame_->ground.all, frame_->view.pixel_rad, facing_indices_, edge_on_indices);
        steps_.add_ground_by_depth(edge_on_indices);
        steps_.add_shadows_by_depth(frame_->ground);
        steps_.add_sky(scene::DepthUse::InfinitelyFar);
        for (auto i = near_to_far_.rbegin(); i != near_to_far_.rend(); ++i) {
            if (placed[*i].is_absent) { continue; }
            for (const Transparent& one : transparents_of(*i)) { paint_transparent(one, scene::DepthUse::Nearest); }
        }
    }

    void paint_in_order() {
        plan_.ground = front_facing(frame_->ground, frame_->view.pixel_rad, facing_indices_);
        boxes_.assign(hulls_.begin(), hulls_.end());
        const auto apart = frame_->transparents.boxes();
        boxes_.insert(boxes_.end(), apart.begin(), apart.end());
        order_.arrange(boxes_);
        steps_.add_sky();
        // The clouds are above all ground.
        const bool from_above = is_above_clouds(frame_->view.camera.eye_m.z);
        if (from_above) { steps_.add_ground(); }
        if (frame_->transparents.cloud_height_m()) {
            paint_groups(true);
            for (const Transparent& one : frame_->transparents.list()) {
                if (one.place == Transparent::Place::CloudLayer) { paint_transparent(one, scene::DepthUse::None); }
            }
        }
        if (!from_above) { steps_.add_ground(); }
        paint_groups(false);
        if (const PlacedAircraft* cockpit = frame_->fleet.cockpit()) { paint(*cockpit, scene::DepthUse::None); }
    }

    bool is_above_clouds(double height_m) const {
        const auto clouds_m = frame_->transparents.cloud_height_m();
        return clouds_m && height_m > *clouds_m;
    }

    /// Paints the groups beyond the clouds, or all others.
    void paint_groups(bool beyond_clouds) {
        const double eye_m = frame_->view.camera.eye_m.z;
        for (const OverlapGroup& group : order_.overlap_groups()) {
            const bool is_beyond = is_above_clouds(eye_m + group.box.centre_m.z) != is_above_clouds(eye_m);
            if (is_beyond == beyond_clouds) { paint_group(group); }
        }
    }

    /// Paints a group, and paints the ground in front of it again, if the group is in view.
    void paint_group(const OverlapGroup& group) {
        collect(group);
        if (members_.empty() && group_transparents_.empty()) { return; }
        if (!in_view(group.box, frame_->view)) {
            for (const PlacedAircraft* member : members_) { add_ranges(*member, scene::DepthUse::None); }
            return;
        }
        in_front_.find(group.box, frame_->mesher, frame_->ground.all, frame_->view.camera.eye_m);
        paint_with_transparents(group);
        if (in_front_.found().empty() || contains_eye(group.box)) { return; }
        // The cones of the members, not that of the group's box: between members a farther group may be visible in
        // front of this ground. In a member's cone everything that was painted earlier is behind the member.
        for (const std::uint32_t member : order_.members(group)) {
            steps_.add_in_front(frame_->ground, in_front_.found(), group.box, cone_of(boxes_[member]));
            counts_->cuts += static_cast<int>(in_front_.found().size());
        }
    }

    /// Collects the aircraft of a group that are present, and the transparent things of the group.
    void collect(const OverlapGroup& group) {
        members_.clear();
        group_transparents_.clear();
        for (const std::uint32_t member : order_.members(group)) {
            if (member < hulls_.size()) {
                const PlacedAircraft& aircraft = frame_->fleet.placed()[member];
                if (aircraft.is_absent) { continue; }
                members_.push_back(&aircraft);
            }
            const auto own = transparents_of(member);
            group_transparents_.insert(group_transparents_.end(), own.begin(), own.end());
        }
    }

    std::span<const Transparent> transparents_of(std::uint32_t box) const {
        const std::span<const Transparent> all = frame_->transparents.list();
        return {std::ranges::lower_bound(all, box, {}, &Transparent::box),
            std::ranges::upper_bound(all, box, {}, &Transparent::box)};
    }

    /// Sorts the transparent things of a group, by their places and from far to near, and paints them and the aircraft.
    void paint_with_transparents(const OverlapGroup& group) {
        const double group_m2 = members_.empty() ? 0.0 : away_m2(group.box);
        const auto stage_of = [&](const Transparent& one) {
            constexpr int last = static_cast<int>(Transparent::Place::CloudLayer);
            const bool is_in_front = one.place == Transparent::Place::Apart && away_m2(boxes_[one.box]) <= group_m2;
            return is_in_front ? last : static_cast<int>(one.place);
        };
        // Discs of one aircraft keep their order.
        std::ranges::stable_sort(group_transparents_, [&](const Transparent& a, const Transparent& b) {
            const int a_stage = stage_of(a);
            const int b_stage = stage_of(b);
            return a_stage != b_stage ? a_stage < b_stage : is_nearer(boxes_, b.box, a.box);
        });
        const auto first_after = std::ranges::find_if(group_transparents_,
            [&](const Transparent& one) { return stage_of(one) >= static_cast<int>(Transparent::Place::Glass); });
        const bool alone = in_front_.intersecting().empty() && members_.size() == 1;
        counts_->overlap_groups += members_.empty() || alone ? 0 : 1;
        if (is_group_by_depth()) {
            paint_members_by_depth(group);
            for (const Transparent& one : group_transparents_) { paint_transparent(one, scene::DepthUse::Nearest); }
            return;
        }
        paint_beside(group, {group_transparents_.begin(), first_after});
        if (alone) {
            add_ranges(*members_.front(), scene::DepthUse::None);
        } else if (!members_.empty()) {
            paint_intersecting(group);
        }
        paint_beside(group, {first_after, group_transparents_.end()});
    }

    /// Whether the aircraft of a group are painted by depth: where one is a mesh, or where what is transparent would
    /// have to come between polygons that are painted again.
    bool is_group_by_depth() const {
        const auto is_between = [&](const Transparent& one) {
            using enum Transparent::Place;
            const bool is_effect = one.place == Behind || one.place == InFront;
            const bool is_within = one.place == Glass || one.place == Disc;
            return (is_within && !in_front_.intersecting().empty()) ||
                   (members_.size() > 1 && (is_effect || is_within));
        };
        return std::ranges::any_of(members_, [](const PlacedAircraft* one) { return is_mesh(*one); }) ||
               std::ranges::any_of(group_transparents_, is_between);
    }

    /// Paints transparent things before the aircraft of their group or after them, behind the ground that intersects
    /// the group. Those with a place among its polygons are not painted.
    void paint_beside(const OverlapGroup& group, std::span<const Transparent> things) {
        if (things.empty()) { return; }
        const std::span<const std::uint32_t> ground = in_front_.intersecting();
        if (!ground.empty()) { begin_depth(group); }
        for (const Transparent& one : things) {
            if (one.place == Transparent::Place::Glass || one.place == Transparent::Place::Disc) { continue; }
            paint_transparent(one, ground.empty() ? scene::DepthUse::None : scene::DepthUse::Nearest);
        }
    }

    /// Paints aircraft that intersect each other or the ground: polygon by polygon, or by depth where that takes too
    /// long.
    void paint_intersecting(const OverlapGroup& group) {
        const StepWriter::Checkpoint before = steps_.checkpoint();
        const double rounding_rad = paint_rounding_px * frame_->view.pixel_rad;
        const auto cuts =
            repaint_.paint(members_, group.box, frame_->ground, in_front_.intersecting(), rounding_rad, steps_);
        if (cuts) {
            counts_->cuts += *cuts;
            return;
        }
        steps_.roll_back(before);
        counts_->unordered += static_cast<int>(members_.size());
        paint_members_by_depth(group);
    }

    /// Leaves no other depth in the buffer, where a group is seen, than that of the ground that intersects it.
    void begin_depth(const OverlapGroup& group) {
        steps_.clear_depth(pixel_box(group.box, plan_, frame_->view.size_px));
        if (!in_front_.intersecting().empty()) { steps_.occlude_by_ground(frame_->ground, in_front_.intersecting()); }
    }

    void paint_members_by_depth(const OverlapGroup& group) {
        begin_depth(group);
        for (const PlacedAircraft* member : members_) { paint(*member, scene::DepthUse::Nearest); }
    }

    /// What of an aircraft is drawn.
    enum class Ranges { All, Opaque, Glass };

    /// Adds ranges of an aircraft in their order; in painting order with its discs.
    void add_ranges(const PlacedAircraft& aircraft, scene::DepthUse depth, Ranges wanted = Ranges::All) {
        const std::span<const scene::IndexRange> ranges(aircraft.ranges);
        std::span<const Transparent> discs;
        if (depth == scene::DepthUse::None) { discs = discs_of(aircraft); }
        const auto next_disc = [&] {
            return discs.empty() ? ranges.size() : aircraft.discs[aircraft.discs.size() - discs.size()].range;
        };
        const auto add_discs_before = [&](std::size_t range) {
            while (!discs.empty() && next_disc() == range) {
                steps_.add_transparent(discs.front().range, depth);
                discs = discs.subspan(1);
            }
        };
        std::size_t end = 0;
        for (std::size_t first = 0; first < ranges.size(); first = end) {
            add_discs_before(first);
            const scene::IndexRange& run = ranges[first];
            end = first + 1;
            while (end < std::min(ranges.size(), next_disc()) && ranges[end].opacity == run.opacity) { ++end; }
            if (wanted != Ranges::All && is_glass(run) != (wanted == Ranges::Glass)) { continue; }
            scene::AircraftDraw draw = draw_of(aircraft, ranges.subspan(first, end - first));
            if (is_mesh(aircraft) && is_glass(run)) { draw.first_smooth = frame_->smooth.turning_word_index(); }
            steps_.add(draw, depth, run.opacity);
        }
        add_discs_before(ranges.size());
    }

    /// One for each of PlacedAircraft::discs; nothing for an aircraft that is out of view or very small.
    std::span<const Transparent> discs_of(const PlacedAircraft& aircraft) const {
        if (aircraft.discs.empty()) { return {}; }
        const auto own = std::ranges::equal_range(
            transparents_of(aircraft.number), Transparent::Place::Disc, {}, &Transparent::place);
        assert(own.empty() || own.size() == aircraft.discs.size());
        return {own.begin(), own.end()};
    }

    /// Paints a whole aircraft, by depth without its glass. Refined meshes are always drawn by depth.
    void paint(const PlacedAircraft& aircraft, scene::DepthUse depth) {
        if (!is_refined(aircraft)) {
            add_ranges(aircraft, depth, depth == scene::DepthUse::None ? Ranges::All : Ranges::Opaque);
            return;
        }
        scene::RefinedDraw draw = frame_->fleet.refined()[aircraft.number]->draw();
        draw.model = aircraft.model_index;
        draw.first_part = aircraft.first_part;
        draw.first_smooth = frame_->smooth.refined_word_index();
        draw.tints = aircraft.tints;
        draw.object = aircraft.object;
        steps_.add(draw);
        add_turning(aircraft, aircraft.model->turning);
        for (std::size_t i = 0; i < aircraft.model->discs.size(); ++i) {
            if (aircraft.disc_strengths[i] < 1.0F) { add_turning(aircraft, aircraft.model->discs[i].blades); }
        }
    }

    /// Adds triangles of AircraftModel::turning, by depth.
    void add_turning(const PlacedAircraft& aircraft, const scene::IndexRange& triangles) {
        if (triangles.index_count == 0) { return; }
        scene::AircraftDraw draw = draw_of(aircraft, triangles.first_index, triangles.index_count);
        draw.first_smooth = frame_->smooth.turning_word_index();
        steps_.add(draw, scene::DepthUse::Nearest);
    }

    /// `depth`: of the aircraft that are in the buffer. Glass has a range of its own only where they are.
    void paint_transparent(const Transparent& one, scene::DepthUse depth) {
        if (one.place != Transparent::Place::Glass) {
            steps_.add_transparent(one.range, depth);
            return;
        }
        add_ranges(frame_->fleet.placed()[one.box], scene::DepthUse::Nearest, Ranges::Glass);
    }

    scene::FramePlan& plan_;
    StepWriter steps_;
    SceneOrder order_;
    GroundInFront in_front_;
    PolygonRepaint repaint_;
    const FrameScene* frame_ = nullptr;
    PlanCounts* counts_ = nullptr;
    std::span<const OrientedBox> hulls_; ///< The boxes of the aircraft.
    std::vector<OrientedBox> boxes_;     ///< hulls_, then Transparents::boxes().
    /// The present aircraft of the current group.
    std::vector<const PlacedAircraft*> members_;
    std::vector<Transparent> group_transparents_;
    std::vector<std::uint32_t> near_to_far_;
    std::vector<std::uint32_t> facing_indices_;
};

ScenePainter::ScenePainter(scene::FramePlan& plan) : painter_(std::make_unique<Painter>(plan)) {}

ScenePainter::~ScenePainter() = default;

void ScenePainter::paint(const FrameScene& frame, scene::HiddenSurface hidden_surface, PlanCounts& counts) {
    painter_->paint(frame, hidden_surface, counts);
}

} // namespace octant::visuals::planning
