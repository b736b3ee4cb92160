#pragma once

#include "sim/base/thread_pool.h"
#include "visuals/nature/ground_decoration.h"
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
    scene::AirSettings air;
    /// Nearest triangles first, for pictures with a depth buffer; else farthest first.
    bool is_front_to_back = false;
    /// A texture colours the ground: neither trees and houses nor roads are on it, which would get its colours.
    bool has_texture = false;
    /// Whether what stands on the ground casts shadows on it.
    bool has_shadows = true;
};

MeshSettings mesh_settings(const scene::Settings& settings, bool has_texture);

/// From where the ground is meshed for one frame, and how finely.
struct MeshRequest {
    scene::Camera camera;
    /// Width of the picture by its height.
    double aspect = 1.0;
    /// At least 1; ground that is always drawn whole ignores it.
    int triangle_target = 20000;
    int picture_height_px = 720;
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

/// One view's meshes of a ground, frame after frame: the detail control and the memory that its frame plans refer to.
/// Each view has its own mesher; the ground is shared and owned by each of its meshers. Calls, in this order:
///
///     loading      reset_detail(request)                     before the first frame, and before one that does not
///                                                            follow the frame before it
///     each frame   triangles(request, counts)                the mesh; advances the detail control by one frame
///                  triangles_in(box_test, numbers)           any number of times, about that mesh
///                  begin_next_mesh(next_request, runner)     optional: prepares the next triangles() on another thread
///     between      wait()                                     ends begin_next_mesh()
///     frames       apply_settings(settings), switch_ground(ground)
///
/// From begin_next_mesh() until the next triangles() nothing may be asked about triangles. The triangles of the last
/// call stay valid until the next triangles().
class GroundMesher {
public:
    virtual ~GroundMesher() = default;
    GroundMesher(const GroundMesher&) = delete;
    GroundMesher& operator=(const GroundMesher&) = delete;
    GroundMesher(GroundMesher&&) = delete;
    GroundMesher& operator=(GroundMesher&&) = delete;

    virtual const Ground& ground() const = 0;

    /// Forgets the frames before, and sets the detail so that the next one meets its target. Loading work where a
    /// detail control averages over frames.
    virtual void reset_detail(const MeshRequest& /*request*/) {}

    /// Uses other settings from the next frame on; the state of the detail control stays. The ground must support the
    /// settings: has_mesh_settings(), asserted by reuse_or_make_mesher(). The decorations are made anew.
    virtual void apply_settings(const MeshSettings& settings);

    /// What stands and lies on the ground in this view, as the settings want it. What stands is among the triangles;
    /// what lies is for whoever draws them. Valid until the next apply_settings().
    const nature::GroundDecorations& decorations() const { return decorations_; }

    /// Uses another ground from the next frame on, if it has the same heights in the same memory and differs only in
    /// colours; apply_settings() must follow. Otherwise returns false and changes nothing.
    virtual bool switch_ground(const std::shared_ptr<const Ground>& /*ground*/) { return false; }

    /// Begins the work of the next triangles() on another thread; that call should have the same request. A second
    /// begin_next_mesh() before it does nothing. Only saves time: the mesh is the same without this call.
    virtual void begin_next_mesh(const MeshRequest& /*request*/, const IdleThreadRunner& /*on_idle_thread*/) {}

    /// Returns when no mesh is being prepared. Rethrows what that work threw; triangles() then makes the mesh itself.
    virtual void wait() {}

    /// The triangles of one frame in painting order, farthest first, valid until the next call, and what they cost.
    /// Advances the detail control by one frame.
    virtual scene::TriangleDraw triangles(const MeshRequest& request, GroundCounts& counts) = 0;

    /// Radius of the earth, metres, by which drawn vertices are lowered with the square of their distance; 0 = flat.
    /// Heights that Ground returns stay heights above datum.
    virtual double earth_radius_m() const { return 0.0; }

    /// Whether the triangles in the box between two corners (world axes, metres) are wanted.
    using BoxTest = std::function<bool(const glm::dvec3& min_m, const glm::dvec3& max_m)>;

    /// Appends the numbers of those triangles of the last triangles() (3 i is the first index of triangle i), in
    /// painting order, that lie in boxes for which `wanted` is true; others may be among them.
    virtual void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const = 0;

protected:
    GroundMesher() = default;

    nature::GroundDecorations decorations_;
};

} // namespace octant::visuals::landscape
