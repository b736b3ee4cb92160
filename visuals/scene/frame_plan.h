#pragma once

#include "models/colour_vertex.h"
#include "models/surface_class.h"
#include "models/texture.h"
#include "visuals/scene/detail_pattern.h"
#include "visuals/scene/land_cover_contrast.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

// FramePlan is the interface between planning and drawing: the planner writes one for each picture, a renderer draws
// it.
//
// All colours are display values (models/material.h), and all arithmetic is done on them directly; README.md of this
// folder describes the consequences.

namespace octant::visuals::scene {

/// A vertex of an aircraft as a renderer loads it once. Body axes x forward, y right, z down. 64 bytes. The normal
/// lights a smooth polygon at this corner; face normal and face colour belong to the flat polygon that begins at this
/// vertex. The corners of a triangle have the same texture; its colour is multiplied by that of both kinds of polygons.
struct ModelVertex {
    glm::vec3 position_m{0.0F};
    glm::vec3 normal{0.0F};
    glm::vec3 face_normal{0.0F};
    /// The colour where the polygon is smooth, as ColourVertex::colour. Alpha 255: no glass; less: glass, which mirrors
    /// the sky (MirroredSky), of an opacity of so many 1/254.
    std::uint32_t colour = 0;
    /// The colour where the polygon is flat, as `colour`.
    std::uint32_t face_colour = 0;
    /// 0 = body, k = pivot k - 1 of the model: turns with FramePlan::parts.
    std::uint32_t part = 0;
    /// Polygon that begins here: a bit of FramePlan::smooth, counted on from the draw's `first_smooth`.
    std::uint32_t polygon = 0;
    /// Where the vertex lies on its texture: shares of its width to the right and of its height down from its upper
    /// left corner; any numbers, as textures go on beyond their edges.
    glm::vec2 on_texture{0.0F};
    /// 0 = no texture, k = ModelBuffers::textures[k - 1] of the model.
    std::uint32_t texture = 0;
};

/// What a renderer loads once for an aircraft: all draw lists lie in one index buffer.
struct ModelBuffers {
    std::vector<ModelVertex> vertices;
    /// Triangles. The first corner of each belongs to it, or to a polygon that it is a part of, alone.
    std::vector<std::uint32_t> indices;
    /// What ModelVertex::texture counts in, also for the refined meshes of this model; often none. Their pictures are
    /// there (not null). TextureAlpha::Blend counts in steps with an opacity below 1, whose opacity it multiplies; in
    /// other steps there is none.
    std::vector<models::SurfaceTexture> textures;
    /// Whether a plan may draw it by depth though its polygons are painted in order: it has levels of detail, or is
    /// refined in each frame.
    bool has_depth_drawn_meshes = false;
};

/// Values over the ground, row after row from the south, each from the west.
struct GroundImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> texels;
    /// The world place of the first texel's middle.
    glm::dvec2 first_m{0.0};
    /// The way from one texel's middle to the next.
    glm::dvec2 step_m{1.0};
};

/// What a renderer loads once for ground that has colours and normals at each pixel instead of at each vertex.
struct GroundTexture {
    /// 3 bytes a texel: red, green, blue as display values, before light falls on it.
    GroundImage albedo;
    /// 2 bytes a texel: x and y of the unit normal, each 128 + 127 x.
    GroundImage normal;
    /// The mean colour of the lit ground, display values 0..1.
    glm::vec3 mean_colour{0.0F};
};

/// How a step uses the depth buffer. Depth is reversed: greater is nearer.
enum class DepthUse {
    /// Drawn over the picture so far; depth is neither tested nor written.
    None,
    /// Drawn where it is nearer than the depth buffer; depth is written.
    Nearest,
    /// As Nearest, but depth alone is written: colours stay as they are.
    DepthOnly,
    /// Drawn where the depth buffer is much farther away; depth is written.
    EdgeOn,
    /// Drawn where it is at the depth buffer's distance or nearer, with a small offset towards the eye; depth is
    /// written.
    OnGround,
    /// Drawn where the depth buffer is clear; depth is not written.
    InfinitelyFar
};

/// The pixels of columns min.x to max.x - 1 and rows min.y to max.y - 1, counted from the picture's upper left corner.
struct PixelBox {
    glm::ivec2 min{0};
    glm::ivec2 max{0};
};

/// The clip planes of a draw: points in front of all of them are drawn. World axes with the eye subtracted; xyz =
/// normal, w = offset.
struct Clip {
    static constexpr int max_planes = 8;
    std::array<glm::vec4, max_planes> planes{};
    int count = 0;
};

/// One step of painting: a range of one of the plan's lists, and how it is drawn.
struct PaintStep {
    enum class Content {
        /// Depth becomes infinitely far in a box of FramePlan::depth_boxes.
        ClearDepth,
        /// Indices of FramePlan::sky are drawn without haze.
        Sky,
        /// Indices of FramePlan::ground are drawn.
        Ground,
        /// Indices of FramePlan::repaint_indices are drawn.
        GroundRepaint,
        /// Aircraft of FramePlan::aircraft are drawn without their back faces.
        Aircraft,
        /// Meshes of FramePlan::refined are drawn without their back faces.
        Refined,
        /// Indices of FramePlan::overlay are blended by their alpha, with DepthUse::Nearest where they are nearer than
        /// the depth buffer, without a change of it; later steps draw over them.
        Transparent,
        /// Indices of FramePlan::overlay are blended by their alpha, after all other steps.
        Overlay
    };
    static constexpr std::uint32_t no_clip = ~std::uint32_t{0};
    Content content = Content::Aircraft;
    /// A place in the list that `content` names.
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    /// Index into FramePlan::clips; `no_clip` = not clipped.
    std::uint32_t clip = no_clip;
    DepthUse depth = DepthUse::None;
    /// For Aircraft only: coverage of the background, 0 to 1. Surfaces below 1 (glass) are blended and come after
    /// everything behind them: where they are nearer than the depth buffer, without a change of it (`depth` is
    /// Nearest), or in painting order (None).
    float opacity = 1.0F;
};

/// A part of a model's index buffer.
struct IndexRange {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    int polygons = 0;
    /// The index of its first polygon in the list whose order the index buffer has (DrawOrder::polygons()); 0 for a
    /// mesh.
    std::uint32_t first_polygon = 0;
    /// Of all its polygons, as PaintStep::opacity.
    float opacity = 1.0F;
};

/// Colours that polygons are shown in instead of their own, without textures, as ColourVertex::colour; 0 = their own.
struct PolygonTints {
    std::uint32_t smooth = 0;
    std::uint32_t flat = 0;
};

/// One aircraft of one frame: one range of its model's index buffer, or several.
struct AircraftDraw {
    /// Index into the models that the renderer has loaded.
    std::uint32_t model = 0;
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    /// Index into FramePlan::parts.
    std::uint32_t first_part = 0;
    /// The word of FramePlan::smooth whose bit 0 is polygon 0.
    std::uint32_t first_smooth = 0;
    PolygonTints tints{};
    /// The number of the aircraft in the ground truth, from 1.
    std::uint32_t object = 0;
    /// Drawn one after the other in place of the range above, if there are any. Memory as TriangleDraw.
    std::span<const IndexRange> ranges{};
};

/// A mesh that is another one in each frame. Memory stays with the maker of the plan, as that of TriangleDraw.
struct RefinedDraw {
    /// ModelVertex::polygon is 0 where a smooth triangle begins, 1 where a flat one does.
    std::span<const ModelVertex> vertices;
    /// Triangles. A flat one's first corner belongs to it alone; a place without a triangle has three equal ones.
    std::span<const std::uint32_t> indices;
    /// Index into FramePlan::parts.
    std::uint32_t first_part = 0;
    /// The word of FramePlan::smooth whose bits 0 and 1 are 1 and 0.
    std::uint32_t first_smooth = 0;
    PolygonTints tints{};
    /// As AircraftDraw::object.
    std::uint32_t object = 0;
    /// Index into the models that the renderer has loaded: the mesh has the textures of this one.
    std::uint32_t model = 0;
};

/// Triangles that lie in world axes with the eye subtracted. Memory stays with the maker of the plan until the next
/// plan.
struct TriangleDraw {
    std::span<const models::ColourVertex> vertices;
    /// Triangles, counter-clockwise seen from above.
    std::span<const std::uint32_t> indices;
    /// The vertices of what stands on the ground, ascending.
    std::span<const models::VertexRun> standing{};
};

/// A vertex of the overlay.
struct OverlayVertex {
    /// Pixels from the picture's upper left corner.
    glm::vec2 at_px{0.0F};
    /// As ColourVertex::colour; alpha says how much of the picture it covers.
    std::uint32_t colour = 0;
    /// As in the depth buffer, for steps that use it: the near plane's distance over that of the vertex, both along the
    /// optical axis.
    float depth = 0.0F;
};

/// Triangles drawn over the picture in their order, either way round, blended by their alpha. Memory as TriangleDraw.
struct OverlayDraw {
    std::span<const OverlayVertex> vertices;
    std::span<const std::uint32_t> indices;
};

/// Where world axes with the eye subtracted lie in a texture: at_eye + position * per_m, in shares of its width from
/// the west and of its height from the south.
struct TextureTransform {
    glm::vec2 at_eye{0.0F};
    glm::vec2 per_m{0.0F};
};

/// Where both parts of the ground's texture lie.
struct GroundTextureTransforms {
    TextureTransform albedo;
    TextureTransform normal;
};

/// Haze between the eye and a point: colour = mix(own, haze, 1 - exp(-depth)), mixed in display values. Depth is
/// distance / visibility times the mean density on the way over that at the eye. Density falls with exp(-height *
/// falloff). The haze's colour is mix(colour, sunward, c^2), where c is the cosine of the way to the level direction of
/// the sun, at least 0.
struct Haze {
    /// The colour of the haze away from the sun, display values 0..1.
    glm::vec3 colour{0.0F};
    /// The visibility at the eye's height; 0 = no haze.
    float visibility_m = 0.0F;
    /// How fast the air gets thinner with height; 0 = it is as dense at all heights.
    float falloff_per_m = 0.0F;
    /// The level direction of the sun, a unit vector east and north; 0 = one colour all around.
    glm::vec2 horizontal_to_sun{0.0F};
    /// The colour of the haze towards the sun, display values 0..1.
    glm::vec3 sunward_colour{0.0F};
};

/// The detail pattern (detail_pattern.h) on ground that its vertices colour. A pixel's colour varies by this pattern
/// and by its vertex's alpha, which is the number of a mixture of land covers (LandCoverContrast). Haze weakens the
/// variation.
struct DetailTexture {
    /// The eye's position in the pattern at each scale, in cubes, 0..1.
    std::array<glm::vec3, DetailPattern::scales> at_eye{};
    std::shared_ptr<const LandCoverContrast> contrast;
};

/// The highlight that FramePlan::lights_pixels adds to surfaces that face the sun: white * sunlight * share *
/// max(c, 0)^power, where c is the cosine between the mirrored light and the direction to the eye.
struct Highlight {
    static constexpr float share = 0.4F;
    static constexpr int power = 24;
};

/// What the glass of aircraft mirrors. Where the line of sight meets it at an angle of cosine c from its normal, it
/// shows (1 - F) own + F / opacity * mirrored: F = f0 + (1 - f0) (1 - c)^5 (Schlick, "An Inexpensive BRDF Model for
/// Physically-based Rendering", 1994), `own` its colour under the light. With r the mirrored line of sight, a unit
/// vector, `mirrored` is mix(h, overhead, t (2 - t)), t = r.z, over the horizon, and mix(h, below, min(-4 r.z, 1))
/// under it, h being the haze's colour towards r; to this comes the sun's glint, glint * sunlight * max(r * to_sun,
/// 0)^power. Computed at the corners of polygons, before the haze.
struct MirroredSky {
    static constexpr float f0 = 0.08F;    ///< of both surfaces of a pane
    static constexpr float glint = 12.0F; ///< so much brighter the sun is than what it lights
    static constexpr int power = 64;

    // Display values 0..1.
    glm::vec3 overhead{0.0F};
    glm::vec3 below{0.0F};
};

/// What the ground shows of its mesh.
enum class MeshDisplay {
    None,
    /// Lines are drawn along the edges of the triangles that are seen.
    Edges,
    /// Lines, and a colour for each halving of the triangles' size.
    Levels
};

/// The level of the water in a picture.
struct WaterSurface {
    /// Above the eye; nothing = there is no water.
    std::optional<float> height_m;
    /// The ground sinks with the square of its distance from the eye by this radius; 0 = it does not.
    float earth_radius_m = 0.0F;
};

/// The camera and the moving parts of the previous picture of a camera.
struct PreviousPicture {
    glm::mat4 world_to_view{1.0F};
    glm::mat4 view_to_clip{1.0F};
    /// The eye less the previous eye, world axes.
    glm::dvec3 eye_moved_m{0.0};
    /// As FramePlan::parts with the previous eye subtracted; all zero for an aircraft that was absent.
    std::vector<glm::mat4> parts;
};

/// What the ground truth of a picture (truth.h) must know beyond what is drawn.
struct TruthSource {
    WaterSurface water;
    /// For each of FramePlan::shadow_vertices what its piece lies on, or is.
    std::vector<models::SurfaceClass> piece_surfaces;
    /// The first of the vertices of FramePlan::sky that belongs to the land around the map.
    std::size_t first_land_vertex = ~std::size_t{0};
    /// Whether the alpha of that land's vertices is 0 on water and nowhere else.
    bool land_has_cover_codes = false;
    /// The indices of FramePlan::overlay that are clouds, and the layer's height above the eye. The layer sinks as the
    /// ground does.
    std::uint32_t first_cloud_index = 0;
    std::uint32_t cloud_index_count = 0;
    float cloud_height_m = 0.0F;
    /// Nothing = no flow.
    std::optional<PreviousPicture> previous;
};

/// Everything a renderer needs for one picture, and nothing of any graphics library. The picture begins as
/// `background`; then `steps` are drawn over it in their order. The other members are the data of the steps; data that
/// no step names is not drawn.
struct FramePlan {
    /// A rotation only: positions are relative to the eye.
    glm::mat4 world_to_view{1.0F};
    /// Depth is reversed, 1 at the near plane and 0 infinitely far.
    glm::mat4 view_to_clip{1.0F};
    /// The colour that the picture begins with, display values 0..1.
    glm::vec3 background{0.0F};
    std::vector<PaintStep> steps;
    std::vector<Clip> clips;
    /// The boxes that ClearDepth steps name; empty where no step uses depth.
    std::vector<PixelBox> depth_boxes;

    TriangleDraw sky;
    /// Triangles that face the eye or are seen edge-on, in the order in which they are drawn, with the pieces of
    /// shadows among them where these are painted in place.
    TriangleDraw ground;
    /// Triangles of ground and shadows that are drawn after the ground: indices of ground.vertices, then of
    /// shadow_vertices, as those of `ground` itself.
    std::vector<std::uint32_t> repaint_indices;
    /// The corners of each triangle of the ground have one colour, which has to reach the picture to the last bit:
    /// polygon numbers.
    bool ground_has_polygon_numbers = false;
    std::vector<models::ColourVertex> shadow_vertices;
    TruthSource truth;
    MeshDisplay mesh_display = MeshDisplay::None;
    /// The spacing of the ground's samples, from which levels are counted.
    float sample_spacing_m = 1.0F;
    /// Ground and shadows are coloured by the renderer's ground texture under `ambient` and `sunlight`, times the
    /// vertices' alpha; nothing = by the vertices' colours. So is what is painted on textured ground: a triangle of
    /// shadow_vertices whose alpha is 0.
    std::optional<GroundTextureTransforms> ground_texture;
    /// The detail pattern on ground and shadows without a texture; nothing = none.
    std::optional<DetailTexture> detail_texture;

    /// Aircraft, in the order in which `steps` first names them.
    std::vector<AircraftDraw> aircraft;
    std::vector<RefinedDraw> refined;
    /// What AircraftDraw::first_part counts in: the body, then each pivot of the model.
    std::vector<glm::mat4> parts;
    /// A bit for each polygon of each aircraft: 1 = lit smoothly (Gouraud), 0 = flat; and a word for all that is
    /// refined.
    std::vector<std::uint32_t> smooth;
    /// Smooth polygons are lit in each pixel (Phong's shading) instead of at their corners.
    bool lights_pixels = false;
    /// Triangles in pixels of the picture, drawn without haze: first transparent geometry (clouds, effects, the path),
    /// whose ranges Transparent steps draw among the aircraft; then the overlay, which the last step draws.
    OverlayDraw overlay;

    Haze haze;
    /// Nothing = glass mirrors nothing.
    std::optional<MirroredSky> mirrored_sky;
    /// The direction to the sun: a unit vector, world axes.
    glm::vec3 to_sun{0.0F, 0.0F, 1.0F};
    /// The light: a colour's display values are multiplied by ambient + sunlight * cosine to the sun, at most 1.
    glm::vec3 ambient{0.45F};
    glm::vec3 sunlight{0.65F};
};

} // namespace octant::visuals::scene
