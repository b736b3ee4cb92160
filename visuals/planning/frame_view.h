#pragma once

#include "models/part_motion.h"
#include "sim/aircraft_state.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/scene/camera.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace octant::visuals::planning {

/// A part of an aircraft that a host program turns and moves, instead of turning by time. The painting order ignores
/// `offset_m`.
struct ArticulatedPart {
    /// Index into Scene::aircraft.
    std::uint32_t aircraft = 0;
    /// Index into PolygonModel::pivots of the aircraft's own model, not of its far model.
    std::uint32_t pivot = 0;
    /// In body axes. Only the component about the pivot's axis counts.
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    /// In body axes.
    glm::dvec3 offset_m{0.0};
};

/// The smooth polygons of a frame: their number, else their share from 0 to 1. With neither the settings decide.
struct SmoothTarget {
    std::optional<int> polygons;
    std::optional<double> share;
};

/// From where, and with which aircraft, the previous picture of the same camera was made.
struct PreviousFrame {
    scene::Camera camera;
    /// As PlanRequest::states.
    std::span<const sim::AircraftState> states;
    /// As PlanRequest::articulated_parts.
    std::span<const ArticulatedPart> articulated_parts = {};
};

/// The input of one frame.
struct PlanRequest {
    scene::Camera camera;
    /// The states of Scene::aircraft.
    std::span<const sim::AircraftState> states;
    /// The triangle budget of the ground, at least 1; nothing = that of the settings.
    std::optional<int> triangle_target = std::nullopt;
    SmoothTarget smooth = {};
    /// Lines written into the upper left corner of the picture.
    std::span<const std::string> overlay_lines = {};
    /// How the controls of Scene::aircraft stand; empty = by control_positions() over the scene's ground.
    std::span<const models::ControlPositions> controls = {};
    /// Parts that a host program turns.
    std::span<const ArticulatedPart> articulated_parts = {};
    /// The size of the picture; nothing = that of the settings.
    std::optional<glm::ivec2> size_px = std::nullopt;
    /// What the flow of the ground truth is counted from (scene::TruthArrays::flow_px); nothing = no flow.
    std::optional<PreviousFrame> previous = std::nullopt;
};

/// The numbers of things that one frame draws.
struct PlanCounts {
    landscape::GroundCounts ground;
    int aircraft_polygons = 0;
    /// The cell of the first aircraft's draw order in which the eye is; 0 unless DrawOrder::has_one_cell_per_eye.
    int draw_cell = 0;
    /// Ground triangles and aircraft polygons that are painted again, clipped.
    int cuts = 0;
    /// Groups of aircraft that intersect or hide each other in a cycle, painted polygon by polygon.
    int overlap_groups = 0;
    /// Aircraft painted by depth, because they intersect each other or the ground in too many places.
    int unordered = 0;
    int shadow_triangles = 0;
    /// Triangles of roads and the runway; GroundCounts::triangles and scenery_triangles include them.
    int painted_triangles = 0;
    /// Triangles of clouds and other transparent things.
    int transparent_triangles = 0;
    /// Polygons of whole models and triangles of refined meshes, and the smooth ones of these.
    int smoothable_polygons = 0;
    int smooth_polygons = 0;
    /// The representation of the first aircraft, 0 = the finest.
    int aircraft_level = 0;
    /// Vertex splits and edge collapses in all refined meshes.
    int refine_splits = 0;
    int refine_collapses = 0;
};

/// The camera of one frame and what derives from it.
struct FrameView {
    scene::Camera camera;
    glm::ivec2 size_px{1};
    double aspect = 1.0;
    /// The angle that a pixel covers in the middle of the picture.
    double pixel_rad = 0.001;
    /// The sides of the view as scene::frustum_normals gives them.
    std::array<glm::dvec3, 4> frustum{};
    /// The radius of the earth, by whose curvature distant things sink; 0 = a flat earth.
    double earth_radius_m = 0.0;
};

FrameView frame_view(const scene::Camera& camera, const glm::ivec2& size_px, double earth_radius_m);

/// False only if no part of the box is in view; may be true for such a box.
bool in_view(const OrientedBox& box, const FrameView& view);

} // namespace octant::visuals::planning
