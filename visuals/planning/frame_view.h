#pragma once

#include "sim/aircraft_state.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/scene/camera.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace octant::visuals::planning {

/// How a part of an aircraft is turned and moved in place of turning by itself. Painting order takes a part as if it
/// were not moved.
struct ArticulatedPart {
    /// Index into Scene::aircraft.
    std::uint32_t aircraft = 0;
    /// Index into PolygonModel::pivots of the aircraft's own model, not of one that stands in for it from afar.
    std::uint32_t pivot = 0;
    /// Within body axes. The part turns about its pivot's axis alone: as far as this turns about it.
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    /// Along body axes.
    glm::dvec3 offset_m{0.0};
};

/// How many polygons are smooth in a frame: a number, else a share from 0 to 1; neither = as the settings say.
struct SmoothTarget {
    std::optional<int> polygons;
    std::optional<double> share;
};

/// What a frame is to show, and how finely.
struct PlanRequest {
    scene::Camera camera;
    /// The states of Scene::aircraft.
    std::span<const sim::AircraftState> states;
    /// Triangles of ground that are aimed at, at least 1; nothing = as the settings say.
    std::optional<int> triangle_target = std::nullopt;
    SmoothTarget smooth = {};
    /// Called when the aircraft are placed and their meshes refined: for whoever measures. May be empty.
    std::function<void()> on_refined = nullptr;
    /// Lines written into the upper left corner of the picture.
    std::span<const std::string> overlay_lines = {};
    /// Parts that do not turn by themselves.
    std::span<const ArticulatedPart> articulated_parts = {};
};

/// What one frame draws.
struct PlanCounts {
    landscape::GroundCounts ground;
    int aircraft_polygons = 0;
    /// The cell of the first aircraft's draw order in which the eye is; 0 where it has parts.
    int draw_cell = 0;
    /// Ground triangles and aircraft polygons painted again, cut by planes.
    int cuts = 0;
    /// Groups of aircraft that meet or stand in a ring, painted by polygons.
    int overlap_groups = 0;
    /// Aircraft painted by depth, as they meet each other or the ground in too many places.
    int unordered = 0;
    int shadow_triangles = 0;
    /// Triangles of roads and the runway; those of the ground have them among them, as what stands on it.
    int painted_triangles = 0;
    /// Triangles in view of clouds and all else that is seen through.
    int transparent_triangles = 0;
    /// Polygons of whole models and triangles of refined meshes, and those of them that are lit smoothly.
    int smoothable_polygons = 0;
    int smooth_polygons = 0;
    /// The representation of the first aircraft, 0 = the finest.
    int aircraft_level = 0;
    /// Vertex splits and edge collapses in all meshes that are refined.
    int refine_splits = 0;
    int refine_collapses = 0;
};

/// From where one frame is seen and what follows from that.
struct FrameView {
    scene::Camera camera;
    glm::ivec2 size_px{1};
    double aspect = 1.0;
    /// The angle that a pixel covers in the middle of the picture.
    double pixel_rad = 0.001;
    /// The sides of the view as scene::frustum_normals gives them.
    std::array<glm::dvec3, 4> frustum{};
    /// The radius of the earth by which what is far sinks; 0 for a flat one.
    double earth_radius_m = 0.0;
};

FrameView frame_view(const scene::Camera& camera, const glm::ivec2& size_px, double earth_radius_m);

/// False only for a box of which nothing is in view.
bool in_view(const OrientedBox& box, const FrameView& view);

} // namespace octant::visuals::planning
