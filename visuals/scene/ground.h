#pragma once

#include "models/heights/height_field.h"
#include "models/polygons/polygon_model.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"
#include "visuals/terrain/ground_tiles.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace octant::visuals::scene {

/// What was drawn of the ground in one frame.
struct GroundCounts {
    int triangles = 0;
    int fans = 0;
    double resolution = 0.0; ///< C; 0 where the screen-space error decides
    double error_px = 0.0;   ///< screen-space error the mesh was made for; 0 where C decides
};

/// What stands below the aircraft: a height field under a quadtree, or polygons painted in one
/// fixed order. Built once at loading.
class Ground {
public:
    virtual ~Ground() = default;
    Ground(const Ground&) = delete;
    Ground& operator=(const Ground&) = delete;
    Ground(Ground&&) = delete;
    Ground& operator=(Ground&&) = delete;

    /// Height of the full-resolution ground; nothing outside the map.
    virtual std::optional<double> height_at(double x_m, double y_m) const = 0;

    /// Half the extent of the map from its centre, east and north, metres.
    virtual glm::dvec2 half_extent_m() const = 0;

    /// Distance of neighbouring samples at full resolution; 0 where there are none.
    virtual double spacing_m() const { return 0.0; }

    /// Mean height above datum, metres, infinite where there is no ground at all, and mean colour
    /// of what is drawn.
    virtual double mean_height_m() const = 0;
    virtual glm::vec3 mean_colour() const = 0;

    /// Sets the detail so that the first frame, seen by this camera, meets its target. Loading
    /// work.
    virtual void settle(const Camera& camera, double aspect) = 0;

    /// Whether follow() can do these settings of the same ground; else it is to be made anew.
    virtual bool can_follow(const Settings& /*settings*/) const { return true; }

    /// Draws by other settings from the next frame on. can_follow() them (asserted).
    virtual void follow(const Settings& /*settings*/) {}

    /// How many triangles the frames from the next one on may have, at least 1. Before the first
    /// call it is triangle_target(settings). Ground that is always drawn whole does not care.
    virtual void set_triangle_target(int /*triangles*/) {}

    /// The triangles of one frame in painting order, farthest first, valid until the next call, and
    /// what they cost. Advances the detail control by one frame.
    virtual TriangleDraw triangles(const Camera& camera, double aspect, GroundCounts& counts) = 0;

    /// Begins the work of the next triangles() beside the caller, for the camera that it will be
    /// given. Until that call nothing else may be asked about triangles; those of the last one stay
    /// valid. May be left out.
    virtual void prepare(const Camera& /*camera*/, double /*aspect*/) {}

    /// Radius of the earth by which what is drawn sinks with the square of its distance, metres; 0
    /// = flat. Heights asked for are those above datum all the same.
    virtual double earth_radius_m() const { return 0.0; }

    /// Whether something between two corners (world axes, metres) is looked for.
    using BoxTest = std::function<bool(const glm::dvec3& least_m, const glm::dvec3& most_m)>;

    /// Appends the numbers of those triangles of the last triangles() (3 i is the first index of
    /// triangle i), in painting order, that lie in boxes of which `wanted` says yes; more may come.
    virtual void
    triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const = 0;

protected:
    Ground() = default;
};

/// A height field under a quadtree whose triangle count is held. Takes the field over.
std::unique_ptr<Ground>
ground_from_field(models::heights::HeightField field, const Settings& settings);

/// Ground under a mesh by screen-space error.
std::unique_ptr<Ground> ground_from_tiles(terrain::GroundTiles ground, const Settings& settings);

/// Polygons painted in file order over a level datum. Body axes of the model: x north, y east, z
/// down. Without polygons: nothing to see and a map of 2,000 km, for aircraft alone.
std::unique_ptr<Ground>
ground_from_polygons(models::polygons::PolygonModel polygons, const Settings& settings);

} // namespace octant::visuals::scene
