#pragma once

#include "visuals/raster/projection.h"
#include "visuals/raster/sample_pattern.h"
#include "visuals/raster/triangle.h"
#include "visuals/raster/vertex_stage.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::raster {

/// How the triangles of one step are drawn.
struct DrawStyle {
    Fill fill = Fill::Gouraud;
    scene::DepthUse depth = scene::DepthUse::None;
    std::uint16_t group = 0; ///< depth group, from 1
    bool culls_back_faces = false;
    bool has_detail_texture = false;          ///< ground whose corners say their share of it
    bool is_cloud = false;                    ///< of the transparent ones
    bool is_sky = false;                      ///< or land around the map
    bool is_land = false;                     ///< ground, what lies on it, the land around the map, the sky
    float opacity = 1.0F;                     ///< as scene::PaintStep
    std::span<const glm::vec4> clip_planes{}; ///< as scene::Clip
};

/// The texture of a triangle.
struct TriangleSurface {
    const MeshTexture* texture = nullptr;
    std::array<glm::vec2, 3> places{};   ///< of its corners in the texture, as scene::ModelVertex::on_texture
    std::array<std::uint16_t, 3> haze{}; ///< as SurfacePlanes
};

/// Triangles of a part of a plan, in painting order.
struct TriangleList {
    std::vector<Triangle> triangles;
    std::vector<TriangleExtra> extras;
    std::vector<SurfacePlanes> surfaces;
};

/// Projects triangles to the screen: clips them, and computes their edges and gradients. One instance for each thread.
class TriangleSetup {
public:
    /// `texture_levels`: mip levels of the ground's texture; 0 = no texture. References must outlive the object.
    TriangleSetup(const Projection& projection, const scene::FramePlan& plan, const SamplePattern& samples,
        std::size_t texture_levels);

    void begin_step(const DrawStyle& style) { style_ = style; }

    /// Triangle::source of all triangles added from now on.
    void set_source(std::uint32_t source) { source_ = source; }

    /// The level in the mesh display (FramePlan::mesh_display) of all triangles added from now on.
    void set_mesh_level(float level) { mesh_level_ = level; }

    /// The texture of the triangle that is added next, of which all corners' colours and `flat` are those of a white
    /// texel; null = it has none. Must outlive that call.
    void set_surface(const TriangleSurface* surface) { surface_ = surface; }

    /// Appends a triangle, given by three indices into `corners`, if any of it may be visible; several triangles if the
    /// view cuts it. `flat`: the colour of its first corner if it is a flat polygon of an aircraft, else null.
    void add(const VertexOutputs& corners, const std::array<std::uint32_t, 3>& triangle, const FlatColour* flat,
        TriangleList& list);

    /// The distance of the near plane.
    float near_m() const { return projection_.near_m; }

    /// Appends a triangle of the overlay, whose fourth value is its alpha: Fill::Gouraud over the picture, else
    /// Fill::Transparent. Its corners' `inverse_w` counts only where the step uses depth.
    void add_overlay(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, TriangleList& list);

private:
    struct ClipVertex {
        ScreenVertex vertex;
        ClipPosition clip;
        glm::vec2 on_texture{0.0F};
    };

    void add_cut(std::span<const ClipVertex> corners, TriangleList& list);
    void add_placed(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, TriangleList& list);
    void cut(const glm::dvec3& by_clip, double offset);
    bool add_affine_triangle(const std::array<const ScreenVertex*, 3>& corners, TriangleList& list);
    Fill fill_of(const std::array<const ScreenVertex*, 3>& corners, bool is_cut) const;
    ClipPosition clip_of(const ScreenVertex& vertex) const;
    void add_extra(std::span<const ClipVertex, 3> corners, TriangleList& list);
    void add_surface(const std::array<const ScreenVertex*, 3>& corners, Triangle& triangle, TriangleList& list) const;

    const Projection& projection_;
    const scene::FramePlan& plan_;
    SamplePattern samples_;
    std::int32_t reach_ = 0; ///< of the samples from a pixel's middle, 1/256 pixel
    std::size_t texture_levels_ = 0;
    DrawStyle style_;
    float mesh_level_ = 0.0F;
    std::uint32_t source_ = 0;
    bool is_overlay_ = false;
    // Of the triangle at hand.
    Fill fill_ = Fill::Gouraud;
    const FlatColour* flat_ = nullptr;      ///< of a flat polygon of an aircraft
    float flat_haze_share_ = 0.0F;          ///< of that polygon, if it has a texture
    std::array<const LitVertex*, 3> lit_{}; ///< of a smooth one that is lit in each pixel
    std::uint32_t extra_ = Triangle::none;
    const TriangleSurface* surface_ = nullptr;
    std::array<glm::vec2, 3> places_{}; ///< as TriangleSurface, of the part at hand
    MipSelection mip_selection_;        ///< of an affine textured triangle
    // Its polygon while the view cuts it.
    std::vector<ClipVertex> polygon_;
    std::vector<ClipVertex> scratch_;
};

} // namespace octant::visuals::raster
