#pragma once

#include "models/surface_class.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>

// The ground truth of a picture: what each pixel shows, as numbers. A pixel shows the polygon that its middle shows.
//
// Clouds count where they cover at least half of the background at the pixel's middle; glass counts as its aircraft.
// The path's ribbon, effects (discs of rotors, plumes, vapour), instruments and all that lies over the picture are left
// out: truth and boxes are those of solid surfaces. Of a rotor that is a disc nothing but the hub is solid;
// SurfaceSettings::effects false shows blades in pictures and truth. Shadows belong to what they lie on.

namespace octant::visuals::scene {

using models::SurfaceClass;

/// Where the truth of a picture is written: rows from the top, without gaps; null = not wanted.
struct TruthArrays {
    /// The distance along the optical axis, metres; infinite where the class is Sky.
    float* depth_m = nullptr;
    /// A SurfaceClass.
    std::uint8_t* class_id = nullptr;
    /// AircraftDraw::object; 0 = none.
    std::uint32_t* object_id = nullptr;
    /// 3 values a pixel: the unit normal of the polygon on the side that is seen, world axes; 0, 0, 0 for the sky.
    float* normal = nullptr;
    /// 2 values a pixel, right and down: the pixel less the place where its surface point was in the picture of
    /// FramePlan::previous. The sky is infinitely far. NaN where the point was behind that camera or its aircraft was
    /// absent, and everywhere without FramePlan::previous.
    float* flow_px = nullptr;
    /// 2 values a pixel: that place itself, column and row, pixel middles at whole numbers.
    float* previous_px = nullptr;
    /// The share of the pixel's samples, 0 to 1, that show the class and the object of its middle. Written where the
    /// middle shows them, therefore 0 for what is thinner than the distance of samples.
    float* coverage = nullptr;
};

/// The class of a triangle that is made of three vertices of FramePlan::ground or FramePlan::shadow_vertices, numbered
/// as FramePlan::repaint_indices are.
SurfaceClass ground_surface(const FramePlan& plan, const std::uint32_t* corners);

/// The class of a triangle of FramePlan::sky: Sky, or the land around the map.
SurfaceClass sky_surface(const FramePlan& plan, const std::uint32_t* corners);

/// Whether a triangle of ground belongs to the water: level, but for a gentle shore, with two corners or three at the
/// water's level or below.
bool is_water(const WaterSurface& water, const std::array<glm::vec3, 3>& corners_m);

/// The class of a triangle of the ground: of what stands there, else water or terrain.
SurfaceClass surface_of(const TriangleDraw& ground, const WaterSurface& water, const std::uint32_t* corners);

/// One triangle of a plan. World axes with the eye subtracted, metres; counter-clockwise seen from outside.
struct SurfaceTriangle {
    std::array<glm::dvec3, 3> corners_m;
    SurfaceClass surface = SurfaceClass::Terrain;
    std::uint32_t object = 0;
};

/// Visits the triangles of which a plan's picture is made: ground that faces the eye, what lies and stands on it, the
/// land around the map, aircraft and refined meshes from all sides. Each triangle once, in the plan's order: what is
/// painted again within clip planes is left out. Sky, clouds and what is left out of the truth are not visited. What
/// lies on ground lies in its plane, a little nearer to the eye. `models`: those that a renderer loads.
void for_each_surface_triangle(const FramePlan& plan, std::span<const ModelBuffers> models,
    const std::function<void(const SurfaceTriangle&)>& visit);

} // namespace octant::visuals::scene
