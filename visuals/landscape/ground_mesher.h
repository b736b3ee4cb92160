#pragma once

#include "visuals/landscape/background_task.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace octant::visuals::landscape {

class Ground;

/// How a view's ground is meshed, and for which pictures.
struct MeshSettings {
    scene::GroundSettings ground;
    int picture_height_px = 720;
    /// Nearest triangles first, for pictures with a depth buffer; else farthest first.
    bool is_front_to_back = false;
    /// A texture colours the ground: it then has no things on it, which would get its colours.
    bool has_texture = false;
};

MeshSettings mesh_settings(const scene::Settings& settings, bool has_texture);

/// From where the ground is meshed for one frame, and how finely.
struct MeshRequest {
    scene::Camera camera;
    /// Width of the picture by its height.
    double aspect = 1.0;
    /// At least 1; ground that is always drawn whole ignores it.
    int triangle_target = 20000;
};

/// What was drawn of the ground in one frame.
struct GroundCounts {
    int triangles = 0;
    int fans = 0;
    /// C; 0 where the screen-space error decides.
    double resolution = 0.0;
    /// The screen-space error that the mesh was made for; 0 where C decides.
    double error_px = 0.0;
    /// Of the triangles, those that detail below the samples has added, and those of what stands on the ground.
    int detail_triangles = 0;
    int scenery_triangles = 0;
};

/// One view's meshes of a ground, frame after frame: the detail control and the memory that its plans point into. Each
/// view has a mesher of its own; the ground is shared. Keeps its ground.
class GroundMesher {
public:
    virtual ~GroundMesher() = default;
    GroundMesher(const GroundMesher&) = delete;
    GroundMesher& operator=(const GroundMesher&) = delete;
    GroundMesher(GroundMesher&&) = delete;
    GroundMesher& operator=(GroundMesher&&) = delete;

    virtual const Ground& ground() const = 0;

    /// Sets the detail so that the first frame meets its target. Loading work.
    virtual void reset_detail(const MeshRequest& /*request*/) {}

    /// Meshes by other settings from the next frame on; the detail control goes on from where it is. The ground
    /// has_mesh_settings() they say (asserted by reuse_or_make_mesher).
    virtual void apply_settings(const MeshSettings& /*settings*/) {}

    /// Goes on over another ground from the next frame on, where that has the same heights in the same memory and only
    /// other colours. Otherwise returns false and has changed nothing.
    virtual bool switch_ground(const std::shared_ptr<const Ground>& /*ground*/) { return false; }

    /// Begins the work of the next triangles() beside the caller, which should then ask for the same, on a thread that
    /// is spared for it or on another one; a second call before that one does nothing. Until that call nothing else may
    /// be asked about triangles; those of the last one stay valid. May be left out: changes no mesh.
    virtual void begin_next_mesh(const MeshRequest& /*request*/, const IdleThreadRunner& /*beside*/) {}

    /// Returns when nothing is being prepared. Throws what that work threw; the mesh is then made when it is asked for.
    virtual void wait() {}

    /// The triangles of one frame in painting order, farthest first, valid until the next call, and what they cost.
    /// Advances the detail control by one frame.
    virtual scene::TriangleDraw triangles(const MeshRequest& request, GroundCounts& counts) = 0;

    /// Radius of the earth by which what is drawn sinks with the square of its distance, metres; 0
    /// = flat. Heights asked of the ground are those above datum all the same.
    virtual double earth_radius_m() const { return 0.0; }

    /// Whether something between two corners (world axes, metres) is looked for.
    using BoxTest = std::function<bool(const glm::dvec3& min_m, const glm::dvec3& max_m)>;

    /// Appends the numbers of those triangles of the last triangles() (3 i is the first index of triangle i), in
    /// painting order, that lie in boxes of which `wanted` says yes; more may come.
    virtual void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const = 0;

protected:
    GroundMesher() = default;
};

} // namespace octant::visuals::landscape
