#pragma once

#include "sim/aircraft_state.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/refined_aircraft.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/settings.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// The state as it is seen over a round earth: sunk as far as the ground below it. `earth_radius_m`: 0 = as it is.
sim::AircraftState sunk(sim::AircraftState state, const glm::dvec3& eye_m, double earth_radius_m);

/// The aircraft of one view, and the cockpit around its eye: their places in each frame, their representations
/// (polygons in the order for its eye point, a level of detail, or a mesh refined for the frame), and their bounding
/// boxes. Levels of detail and refined meshes depend on the frames before.
class Fleet {
public:
    /// The scene and the settings must outlive it.
    Fleet(const Scene& scene, const scene::Settings& settings);

    /// How the parts of an aircraft stand.
    struct PartPositions {
        models::ControlPositions controls{};
        std::span<const ArticulatedPart> articulated_parts;
    };

    /// Where the controls of an aircraft in that state stand over the scene's ground; at rest where they move nothing.
    models::ControlPositions controls_of(const PlacedAircraft& aircraft, const sim::AircraftState& state) const;

    /// Writes placed(), bounding_boxes() and parts() for a frame. `effect_bounds`: for each of Scene::aircraft the
    /// bounds of its effects, in body axes, which its bounding box encloses, too.
    void place(const FrameView& view, const PlanRequest& request,
        std::span<const std::optional<AxisAlignedBox>> effect_bounds);

    /// Writes to `parts` where the parts of placed() were in an earlier frame, as parts() is numbered, with the eye of
    /// `view` subtracted; zero for absent aircraft. Follows place().
    void place_before(const FrameView& view, const PreviousFrame& before, std::span<glm::mat4> parts) const;

    /// Refines the progressive meshes of the aircraft that are drawn by one. Follows place().
    void refine(const FrameView& view);

    /// Forgets the frames before: the next one is placed and refined as the first of a new fleet.
    void forget_frames();

    /// Those of Scene::aircraft, then the cockpit where the view is from inside one.
    std::span<const PlacedAircraft> placed() const { return placed_; }

    std::span<PlacedAircraft> placed() { return placed_; }

    /// The boxes of Scene::aircraft.
    std::span<const OrientedBox> bounding_boxes() const { return bounding_boxes_; }

    /// The cockpit around the eye, nearer than all else; null where the view is from outside.
    const PlacedAircraft* cockpit() const {
        return placed_.size() > bounding_boxes_.size() ? &placed_.back() : nullptr;
    }

    /// The refined mesh of each of placed(); null for models without a progressive mesh.
    std::span<const std::unique_ptr<RefinedAircraft>> refined() const { return refined_; }

    /// The list into which ViewedAircraft::first_part is an index.
    std::span<const glm::dmat4> parts() const { return parts_; }

    /// Vertex splits and edge collapses in all refined meshes for this frame.
    int splits() const { return splits_; }

    int collapses() const { return collapses_; }

private:
    /// The detail of an aircraft in the last frame, on which that of this frame depends.
    struct LastDetail {
        bool is_far = false;
        bool is_refined = false;
        /// Nothing where the aircraft was out of view: its representation is then chosen without hysteresis.
        std::optional<std::size_t> representation;
    };

    void add(std::uint32_t model);
    void place(PlacedAircraft& aircraft, const sim::AircraftState& state, const PartPositions& positions,
        const FrameView& view);
    void choose_model(PlacedAircraft& aircraft, double distance_m, const FrameView& view);
    void choose_representation(PlacedAircraft& aircraft, const FrameView& view);
    std::vector<float> disc_strengths(const PlacedAircraft& aircraft, const AircraftModel& model,
        std::span<const glm::dmat4> parts, const PartPositions& positions, const FrameView& view) const;
    void choose_ranges(PlacedAircraft& aircraft, const glm::dvec3& eye_in_body_m);
    void append_ranges(const draworder::DrawOrder& order, std::span<const std::uint32_t> first_indices,
        std::span<const OpacityRun> runs, const glm::dvec3& eye_in_body_m, PlacedAircraft& aircraft);
    void append_run(const OpacityRun& run, const scene::IndexRange& range, PlacedAircraft& aircraft) const;
    OrientedBox bounding_box_of(const PlacedAircraft& aircraft, const sim::AircraftState& state,
        const std::optional<AxisAlignedBox>& effects, const FrameView& view) const;

    const Scene& scene_;
    const scene::Settings& settings_;
    std::vector<PlacedAircraft> placed_;
    std::vector<OrientedBox> bounding_boxes_;
    std::vector<glm::dmat4> parts_;
    std::vector<std::vector<glm::dmat4>> far_parts_; ///< PlacedAircraft::far_parts of each of placed_.
    draworder::DrawOrder::Walk walk_;
    std::vector<std::unique_ptr<RefinedAircraft>> refined_;
    std::vector<LastDetail> last_; ///< One for each of placed_.
    int splits_ = 0;
    int collapses_ = 0;
};

} // namespace octant::visuals::planning
