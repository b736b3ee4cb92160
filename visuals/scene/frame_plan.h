#pragma once

#include "models/colour_vertex.h"
#include "visuals/scene/detail_pattern.h"
#include "visuals/scene/land_cover_contrast.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

// The seam between deciding and drawing: the planner writes a FramePlan, a renderer draws it.
//
// All colours are display values (models/material.h), and all arithmetic is done on them directly; README.md of this
// folder says what that costs.

namespace octant::visuals::scene {

/// A vertex of an aircraft as a renderer loads it once. Body axes x forward, y right, z down. 52 bytes. The normal
/// lights a smooth polygon at this corner; face normal and face colour belong to the flat polygon that begins at this
/// vertex.
struct ModelVertex {
    glm::vec3 position_m{0.0F};
    glm::vec3 normal{0.0F};
    glm::vec3 face_normal{0.0F};
    /// The colour where the polygon is smooth, as ColourVertex::colour.
    std::uint32_t colour = 0;
    /// The colour where the polygon is flat, as ColourVertex::colour.
    std::uint32_t face_colour = 0;
    /// 0 = body, k = pivot k - 1 of the model: turns with FramePlan::parts.
    std::uint32_t part = 0;
    /// Polygon that begins here: a bit of FramePlan::smooth, counted on from the draw's `first_smooth`.
    std::uint32_t polygon = 0;
};

/// What a renderer loads once for an aircraft: all draw lists lie in one index buffer.
struct ModelBuffers {
    std::vector<ModelVertex> vertices;
    /// Triangles. The first corner of each belongs to it, or to a polygon that it is a part of, alone.
    std::vector<std::uint32_t> indices;
    /// Whether a plan may draw it by depth though its polygons are painted in order: it has levels of detail, or is
    /// refined in each frame.
    bool has_depth_drawn_meshes = false;
};

/// How a step uses the depth buffer. Depth is reversed: greater is nearer.
enum class DepthUse {
    /// Drawn over whatever is there; depth is neither tested nor written.
    None,
    /// Drawn where it is nearer than what is there; depth is written.
    Nearest,
    /// As Nearest, but depth alone is written: colours stay as they are.
    DepthOnly,
    /// Drawn where there is nothing but what lies well behind it; depth is written.
    EdgeOn,
    /// Drawn where it lies on what is there, a little towards the eye; depth is written.
    OnGround,
    /// Drawn where nothing is; depth is not written.
    InfinitelyFar
};

/// Pixels of the picture from its upper left corner: columns least.x to most.x - 1, rows alike.
struct PixelBox {
    glm::ivec2 least{0};
    glm::ivec2 most{0};
};

/// Planes that a draw is cut by: what lies in front of all of them is drawn. World axes with the eye subtracted; xyz =
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
        /// Indices of FramePlan::overlay are drawn as Overlay draws them; what comes later is drawn over it.
        Transparent,
        /// Indices of FramePlan::overlay are blended by their alpha, after all others.
        Overlay
    };
    static constexpr std::uint32_t no_clip = ~std::uint32_t{0};
    Content content = Content::Aircraft;
    /// A place in the list that `content` names.
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    /// Index into FramePlan::clips; `no_clip` = what is drawn is not cut.
    std::uint32_t clip = no_clip;
    DepthUse depth = DepthUse::None;
    /// Aircraft alone: how much of what is there they hide. Below 1 they are blended over it where their depth, which
    /// is Nearest, says so, and depth is not written: clear surfaces, drawn after all that they may be seen before.
    float opacity = 1.0F;
};

/// A part of a model's index buffer.
struct IndexRange {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    int polygons = 0;
    /// Where its polygons begin in the list that the index buffer follows; 0 for a mesh.
    std::uint32_t first_polygon = 0;
};

/// Colours that polygons are shown in instead of their own, as ColourVertex::colour; 0 = their own.
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
};

/// Triangles that lie in world axes with the eye subtracted. Memory stays with the maker of the plan until the next
/// plan.
struct TriangleDraw {
    std::span<const models::ColourVertex> vertices;
    /// Triangles, counter-clockwise seen from above.
    std::span<const std::uint32_t> indices;
};

/// A corner of what is drawn over the picture.
struct OverlayVertex {
    /// Pixels from the picture's upper left corner.
    glm::vec2 at_px{0.0F};
    /// As ColourVertex::colour; alpha says how much of the picture it covers.
    std::uint32_t colour = 0;
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

/// Air between the eye and what is seen: colour = mix(own, haze, 1 - exp(-depth)), mixed in display values. Depth is
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

/// The fine pattern (grain_pattern.h) on ground that its vertices colour. By it and by a vertex's alpha, the number of
/// a mixture of covers, a pixel differs from its colour, and by so much less as haze lies before it.
struct DetailTexture {
    /// Where the eye stands in the pattern at each scale, in tiles, 0..1.
    std::array<glm::vec2, DetailPattern::scales> at_eye{};
    /// How high the eye is above the pattern's origin, likewise: for slopes that show it upright.
    std::array<float, DetailPattern::scales> eye_height_tiles{};
    std::shared_ptr<const LandCoverContrast> contrast;
};

/// What a surface that is lit in each pixel has beside the light of all others, where it faces the sun: white *
/// sunlight * share * max(c, 0)^power, where c is the cosine between the mirrored light and the way to the eye.
struct Highlight {
    static constexpr float share = 0.4F;
    static constexpr int power = 24;
};

/// What the ground shows of its mesh.
enum class MeshDisplay {
    None,
    /// Lines are drawn along the edges of the triangles that are seen.
    Edges,
    /// Lines, and a colour for each halving of the triangles' size.
    Levels
};

/// Everything a renderer needs for one picture, and nothing of any graphics library. The picture begins as
/// `background`; then each of `steps` is drawn over what is there, in their order. What no step names is not drawn: the
/// other members say with what and under which light.
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
    MeshDisplay mesh_display = MeshDisplay::None;
    /// The spacing of the ground's samples, from which levels are counted.
    float sample_spacing_m = 1.0F;
    /// Ground and shadows are coloured by the renderer's ground texture under `ambient` and `sunlight`, times the
    /// vertices' alpha; nothing = by the vertices' colours. So is what is painted on textured ground: a triangle of
    /// shadow_vertices whose alpha is 0.
    std::optional<GroundTextureTransforms> ground_texture;
    /// The fine pattern on ground and shadows without a texture; nothing = none.
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
    /// What is drawn on the picture without haze: veils, which lie behind what later steps draw, and then what lies
    /// over the picture.
    OverlayDraw overlay;

    Haze haze;
    /// The direction to the sun: a unit vector, world axes.
    glm::vec3 to_sun{0.0F, 0.0F, 1.0F};
    /// Light on what is lit here: a colour's display values times ambient + sunlight * cosine to the sun, cut at 1.
    glm::vec3 ambient{0.45F};
    glm::vec3 sunlight{0.65F};
};

} // namespace octant::visuals::scene
