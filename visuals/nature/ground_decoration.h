#pragma once

#include "models/colour_vertex.h"
#include "models/surface_class.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace octant::visuals::nature {

/// From where ground is looked at, how finely it is sampled, and how much detail a frame may add to it near the eye.
struct NearDetailView {
    glm::dvec3 eye_m{0.0}; ///< world axes
    double spacing_m = 30.0;
    terrain::PaintOrder order = terrain::PaintOrder::BackToFront;
    /// Unit normals of planes through the eye, world axes, that point inside: edges outside one are not halved. Zero =
    /// no plane.
    std::array<glm::vec3, 4> frustum_normals{glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F)};
    std::size_t max_splits = 2000;            ///< triangles that may be added to the ground in a frame
    std::size_t max_scenery_triangles = 5000; ///< triangles of what stands on it
    float min_edge_rad = 0.08F;               ///< edges of the ground that look shorter stay whole
    float range_ratio = 1.0F;                 ///< of the distance to which things stand
    float focal_px = 869.0F;                  ///< as DetailBudget::focal_px
};

/// What may stand in a cell of the ground: shares of places, 0..1, and the sunlight there.
struct SceneryDensity {
    float broadleaves = 0.0F;
    float conifers = 0.0F;
    float shrubs = 0.0F;
    float houses = 0.0F;
    float sun = 1.0F; ///< 0 in the shadow of the relief
};

/// A convex quadrangle of one colour that lies on the ground. Metres east and north of the eye.
struct GroundPatch {
    using Corners = std::array<glm::dvec2, 4>;

    /// Counter-clockwise.
    explicit GroundPatch(const Corners& corners)
        : corners_m(corners), min_m(glm::min(glm::min(corners[0], corners[1]), glm::min(corners[2], corners[3]))),
          max_m(glm::max(glm::max(corners[0], corners[1]), glm::max(corners[2], corners[3]))) {}

    Corners corners_m;
    glm::dvec2 min_m;
    glm::dvec2 max_m;
    glm::vec3 colour{0.0F};  ///< display values, lit
    float own_share = 1.0F;  ///< of that colour; the rest is the colour of the ground below
    bool is_marking = false; ///< painted on another patch
    bool is_required = true; ///< false: left out where a frame has no triangles left
    bool is_on_water = true; ///< false: left out on triangles of water, and of what stands on the ground
    models::SurfaceClass surface = models::SurfaceClass::Road;
};

/// The scale factor towards the eye of what lies so many layers above the ground: for a depth buffer each layer is in
/// front of the one below by 256 float steps, at the same pixels.
constexpr float depth_offset_factor(float layers) { return 1.0F - layers * 0x1p-15F; }

/// Lists to which what stands on the ground is appended.
struct StandingTriangles {
    std::vector<models::ColourVertex>& vertices;
    std::vector<std::uint32_t>& indices;
    std::vector<models::VertexRun>& runs; ///< of what is appended to `vertices`
};

/// One kind of thing that stands on the ground (trees and houses) or lies on it (roads, a runway), for one view. A
/// mesher of ground has a list of them; whoever draws the ground asks each for what it adds. All colours are lit by the
/// daylight for which the list was made. Each function has nothing to add unless a kind overrides it.
///
/// Shadows of aircraft are no decoration, although they are cut to the triangles of the ground in the same way. A
/// decoration belongs to the ground and has colours of its own; a shadow belongs to the aircraft of one frame and
/// darkens the ground and the patches below it. visuals/planning/ground_pieces.h lays the patches, then casts the
/// shadows.
class GroundDecoration {
public:
    GroundDecoration() = default;
    virtual ~GroundDecoration() = default;
    GroundDecoration(const GroundDecoration&) = delete;
    GroundDecoration& operator=(const GroundDecoration&) = delete;
    GroundDecoration(GroundDecoration&&) = delete;
    GroundDecoration& operator=(GroundDecoration&&) = delete;

    // Standing: triangles that are painted right after the triangle of the ground on which they stand.

    /// Changes what stands in the cell of the sample grid with this middle (world axes).
    virtual void limit_scenery(const glm::dvec2& /*middle_m*/, double /*cell_m*/, SceneryDensity& /*density*/) const {}

    /// Begins a frame: the next calls are about this view.
    virtual void begin_standing(const NearDetailView& /*view*/) {}

    /// Farther off nothing stands; 0 = nothing stands anywhere.
    virtual double reach_m() const { return 0.0; }

    /// The height of the tallest thing above its ground.
    virtual double height_m() const { return 0.0; }

    /// Whether anything stands in a quarter of a cell that holds a place (world axes) or ends there: the ground stays
    /// even below it.
    virtual bool stands_at(const glm::dvec2& /*place_m*/) { return false; }

    /// Appends what stands on a triangle as drawn, none of it below the triangle's plane, from near to far; triangles
    /// are counter-clockwise seen from outside.
    virtual void add_standing(
        const std::array<models::ColourVertex, 3>& /*triangle*/, const StandingTriangles& /*to*/) {}

    /// Appends the shadows of what stands on the triangle of the last add_standing() and around it that fall on a part
    /// of that triangle as drawn.
    virtual void add_shadows(const std::array<models::ColourVertex, 3>& /*part*/, const StandingTriangles& /*to*/) {}

    // Lying: patches that are cut to the triangles of the ground and painted right after them.

    /// The most triangles of patches in a view from this eye (world axes) whose pixels cover `pixel_rad`, where
    /// `triangle_target` triangles of ground are aimed at.
    virtual int max_patch_triangles(const glm::dvec3& /*eye_m*/, double /*pixel_rad*/, int /*triangle_target*/) const {
        return 0;
    }

    /// Begins a frame: the next calls are about the view from this eye. False where nothing can be seen to lie on the
    /// ground.
    virtual bool begin_lying(const glm::dvec3& /*eye_m*/, double /*pixel_rad*/) { return false; }

    /// False only where nothing lies in a rectangle of the map (world axes).
    virtual bool may_lie_in(const glm::dvec2& /*min_m*/, const glm::dvec2& /*max_m*/) const { return false; }

    /// Appends the patches that may lie in a rectangle, metres east and north of the eye, in painting order.
    virtual void find_patches(
        const glm::dvec2& /*min_m*/, const glm::dvec2& /*max_m*/, std::vector<GroundPatch>& /*patches*/) {}
};

/// What stands and lies on the ground of one view.
using GroundDecorations = std::vector<std::unique_ptr<GroundDecoration>>;

} // namespace octant::visuals::nature
