#pragma once

#include "models/colour_vertex.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::scene {

/// How hidden surfaces of aircraft are removed.
enum class HiddenSurface {
    Octant,      ///< polygons painted in precomputed order, no depth anywhere
    DepthBuffer, ///< 32-bit float, reversed
    BackFace     ///< back faces removed, polygons in file order: the 1989 paper's fast, wrong way
};

/// A vertex of an aircraft as uploaded once at loading. Body axes x forward, y right, z down. 52
/// bytes.
struct ModelVertex {
    glm::vec3 position_m{0.0F};
    glm::vec3 normal{0.0F};        ///< of the surface there: what a smooth polygon is lit by
    glm::vec3 face_normal{0.0F};   ///< of the polygon that begins here: what a flat one is lit by
    std::uint32_t colour = 0;      ///< as ColourVertex::colour
    std::uint32_t face_colour = 0; ///< of the polygon that begins here, where that is flat
    std::uint32_t part = 0; ///< 0 = body, k = pivot k - 1 of the model: turns with FramePlan::parts
    std::uint32_t polygon = 0; ///< that begins here: AircraftDraw::first_smooth counts on from it
};

/// What a renderer uploads once for an aircraft: all draw lists lie in one index buffer.
struct ModelBuffers {
    std::vector<ModelVertex> vertices;
    /// Triangles. The first corner of each belongs to it, or to a polygon that it is a part of,
    /// alone.
    std::vector<std::uint32_t> indices;
    bool has_meshes = false; ///< whether a plan may ask for PaintStep::What::Solid
};

/// Colours that polygons are shown in instead of their own, as ColourVertex::colour; 0 = their own.
struct Tints {
    std::uint32_t smooth = 0; ///< of the smooth ones
    std::uint32_t flat = 0;   ///< of the flat ones
};

/// One aircraft of one frame: one range of its model's index buffer.
struct AircraftDraw {
    std::uint32_t model = 0; ///< index into the ModelBuffers given to the renderer
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    std::uint32_t first_part = 0;   ///< index into FramePlan::parts
    std::uint32_t first_smooth = 0; ///< word of FramePlan::smooth whose bit 0 is polygon 0
    Tints tints{};
};

/// A mesh that is another one in each frame. Memory as TriangleDraw.
struct RefinedDraw {
    /// ModelVertex::polygon is 0 where a smooth triangle begins, 1 where a flat one does.
    std::span<const ModelVertex> vertices;
    /// Triangles. A flat one's first corner belongs to it alone; a place without a triangle has
    /// three equal ones.
    std::span<const std::uint32_t> indices;
    std::uint32_t first_part = 0;   ///< index into FramePlan::parts
    std::uint32_t first_smooth = 0; ///< word of FramePlan::smooth whose bits 0 and 1 are 1 and 0
    Tints tints{};
};

/// Pixels of the picture from its upper left corner: columns least.x to most.x - 1, rows alike.
struct PixelBox {
    glm::ivec2 least{0};
    glm::ivec2 most{0};
};

/// Planes that a draw is cut by: world axes with the eye subtracted, what lies in front of all of
/// them is drawn. xyz = normal, w = offset.
struct Clip {
    static constexpr int most_planes = 8;
    std::array<glm::vec4, most_planes> planes{};
    int count = 0;
};

/// One step of painting after the ground.
struct PaintStep {
    enum class What {
        Aircraft,   ///< FramePlan::aircraft first .. first + count - 1
        Ground,     ///< ground triangles once more: FramePlan::repaint_indices first .. + count - 1
        ClearDepth, ///< depth becomes infinitely far in FramePlan::depth_boxes first
        GroundDepth, ///< as Ground, but only its depth is drawn
        Solid,       ///< as Aircraft, hidden by what depth is there; never cut
        Refined      ///< FramePlan::refined first .. first + count - 1, likewise
    };
    static constexpr std::uint32_t whole = ~std::uint32_t{0};
    What what = What::Aircraft;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t clip = whole; ///< index into FramePlan::clips; whole = not cut
};

/// Triangles that lie in world axes with the eye subtracted. Memory stays with the maker of the
/// plan until the next plan.
struct TriangleDraw {
    std::span<const models::ColourVertex> vertices;
    std::span<const std::uint32_t> indices; ///< triangles, counter-clockwise seen from above
};

/// A corner of what is drawn over the picture, in pixels from its upper left corner.
struct OverlayVertex {
    glm::vec2 at_px{0.0F};
    std::uint32_t colour =
        0; ///< as ColourVertex::colour; alpha = how much of the picture it covers
};

/// Triangles drawn over the picture in their order, either way round, blended by their alpha.
/// Memory as TriangleDraw.
struct OverlayDraw {
    std::span<const OverlayVertex> vertices;
    std::span<const std::uint32_t> indices;
};

/// Where world axes with the eye subtracted lie in a texture: at_eye + position * per_m, in shares
/// of its width from the west and of its height from the south.
struct TexturePlace {
    glm::vec2 at_eye{0.0F};
    glm::vec2 per_m{0.0F};
};

/// Of both parts of the ground's texture.
struct TexturePlaces {
    TexturePlace albedo;
    TexturePlace normal;
};

/// Air between the eye and what is seen: colour = mix(own, haze, 1 - exp(-distance / visibility)).
struct Haze {
    glm::vec3 colour{0.0F};    ///< linear parts 0..1
    float visibility_m = 0.0F; ///< distance at which 1/e of the own colour is left; 0 = no haze
};

/// What the ground shows of its mesh.
enum class MeshLook {
    None,
    Edges, ///< lines along the edges of the triangles that are seen
    Levels ///< the same, and a colour for each halving of the triangles' size
};

/// Everything a renderer needs for one picture, and nothing of any graphics library. Painted in
/// the order background, sky, ground, aircraft.
struct FramePlan {
    glm::mat4 world_to_view{1.0F}; ///< rotation only: positions are relative to the eye
    glm::mat4 view_to_clip{1.0F};  ///< reversed depth 1..0, infinite far plane
    glm::vec3 background{0.0F};    ///< what the picture is cleared to
    Haze haze;
    TriangleDraw sky; ///< no depth, no haze; empty when the sky is off
    /// Facing the eye or edge-on. Octant, BackFace: in painting order, with shadow pieces in place.
    /// DepthBuffer: nearest first.
    TriangleDraw ground;
    /// DepthBuffer: how many of ground.indices, at their end, belong to triangles that face away
    /// but for rounding. They only close holes along edges; elsewhere their depths mean nothing.
    std::size_t edge_on_indices = 0;
    MeshLook mesh_look = MeshLook::None;
    float sample_spacing_m = 1.0F; ///< of the ground: what levels are counted from
    HiddenSurface hidden_surface = HiddenSurface::Octant;
    std::vector<AircraftDraw> aircraft; ///< in the order in which `steps` first names them
    std::vector<RefinedDraw> refined;
    std::vector<glm::mat4> parts; ///< AircraftDraw::first_part: body, then each pivot of the model
    /// Octant, BackFace: what is painted after the ground, in this order; it names every aircraft
    /// at least once. DepthBuffer: one step with all aircraft, nearest first, and what
    /// is refined.
    std::vector<PaintStep> steps;
    std::vector<Clip> clips;
    std::vector<PixelBox> depth_boxes; ///< not empty: some steps need a depth buffer
    /// A bit for each polygon of each aircraft: 1 = lit smoothly (Gouraud), 0 = flat; and a word
    /// for all that is refined.
    std::vector<std::uint32_t> smooth;
    std::vector<std::uint32_t> repaint_indices; ///< of ground.vertices, then shadow_vertices
    /// Shadow pieces. Their indices count on after ground.vertices.
    std::vector<models::ColourVertex> shadow_vertices;
    std::vector<std::uint32_t> shadow_indices; ///< DepthBuffer: drawn on the ground; else empty,
                                               ///< because ground.indices holds them in their place
    /// Ground, repainted ground and shadows are coloured by the renderer's ground texture under
    /// `ambient` and `sunlight`, times the vertices' alpha; nothing = by the vertices' colours.
    std::optional<TexturePlaces> ground_texture;
    glm::vec3 to_sun{0.0F, 0.0F, 1.0F}; ///< unit vector, world axes
    glm::vec3 ambient{0.45F};           ///< light on what is lit here from everywhere, linear
    glm::vec3 sunlight{0.65F};          ///< light from the sun, times the cosine to it
    OverlayDraw overlay;                ///< over everything, without depth or haze; may be empty
};

} // namespace octant::visuals::scene
