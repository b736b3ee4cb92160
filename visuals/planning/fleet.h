#pragma once

#include "sim/aircraft_state.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/planning/aircraft_effects.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/refined_aircraft.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/settings.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// The aircraft of one view, and the cockpit around its eye: where each one is in a frame, as what it is drawn
/// (polygons in the order of its eye point, a level of detail, or a mesh refined for the frame), and the box that
/// stands in for it. Levels and refined meshes go on from frame to frame. Keeps its memory.
class Fleet {
public:
    /// The scene and the settings must outlive it.
    Fleet(const Scene& scene, const scene::Settings& settings);

    /// Decides where each aircraft is, which list it is painted by and which box stands in for it. `effects`: one for
    /// each of Scene::aircraft, which its box holds, too, or none at all.
    void place(const FrameView& view, const PlanRequest& request, std::span<const AircraftEffects> effects);

    /// Refines the meshes of the aircraft that are drawn as meshes; those drawn as polygons keep theirs as they are.
    void refine(const FrameView& view);

    /// Those of Scene::aircraft, then the cockpit where the view is from inside one.
    std::span<const PlacedAircraft> placed() const { return placed_; }

    std::span<PlacedAircraft> placed() { return placed_; }

    /// The boxes of Scene::aircraft.
    std::span<const OrientedBox> bounding_boxes() const { return bounding_boxes_; }

    /// What is around the eye: nearer than all else. Null where the view is from outside.
    const PlacedAircraft* cockpit() const {
        return placed_.size() > bounding_boxes_.size() ? &placed_.back() : nullptr;
    }

    /// The meshes that are refined, one for each of placed(): null for most.
    std::span<const std::unique_ptr<RefinedAircraft>> refined() const { return refined_; }

    /// The matrices that PlacedAircraft::first_part counts.
    std::span<const glm::dmat4> parts() const { return parts_; }

    /// Vertex splits and edge collapses in all refined meshes for this frame.
    int splits() const { return splits_; }

    int collapses() const { return collapses_; }

private:
    void add(std::uint32_t model);
    void place(PlacedAircraft& aircraft, const sim::AircraftState& state,
        std::span<const ArticulatedPart> articulated_parts, const FrameView& view);
    void choose_model(PlacedAircraft& aircraft, double distance_m, const FrameView& view);
    void choose_representation(PlacedAircraft& aircraft, const FrameView& view) const;
    void choose_ranges(PlacedAircraft& aircraft, const glm::dvec3& eye_in_body_m);
    OrientedBox bounding_box_of(const PlacedAircraft& aircraft, const sim::AircraftState& state,
        const AircraftEffects* effects, const FrameView& view) const;

    const Scene& scene_;
    const scene::Settings& settings_;
    std::vector<PlacedAircraft> placed_;
    std::vector<OrientedBox> bounding_boxes_;
    std::vector<glm::dmat4> parts_;
    draworder::DrawOrder::Walk walk_;
    std::vector<std::unique_ptr<RefinedAircraft>> refined_;
    /// Whether each of placed_ was drawn as a refined mesh in the last frame.
    std::vector<std::uint8_t> was_refined_;
    int splits_ = 0;
    int collapses_ = 0;
};

} // namespace octant::visuals::planning
