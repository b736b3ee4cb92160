#pragma once

#include "visuals/landscape/ground_mesher.h"
#include "visuals/nature/ground_decoration.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// A convex polygon in the plane of a triangle of the ground and inside it, opaque and of one colour: that of a vertex
/// without the ground's fine pattern or texture.
struct GroundDecal {
    std::uint32_t triangle = 0; ///< its number in GroundMesher::triangles()
    std::uint32_t first = 0;    ///< of its corners
    std::uint32_t count = 0;
    std::uint32_t colour = 0;
    GroundLayer layer = GroundLayer::Surface;
};

/// Makes the pieces that lie on the ground of a frame, each cut to one triangle of the ground: decals of decorations,
/// and shadows of aircraft on the ground and on the decals. For each frame: begin(), lay() and cast() in this order,
/// finish(). Keeps its memory.
class GroundPieces {
public:
    GroundPieces();
    GroundPieces(const GroundPieces&) = delete;
    GroundPieces& operator=(const GroundPieces&) = delete;
    GroundPieces(GroundPieces&&) = delete;
    GroundPieces& operator=(GroundPieces&&) = delete;
    ~GroundPieces();

    /// The ground of a frame. All of it must stay until the next begin().
    struct Ground {
        const FrameView& view;
        const landscape::GroundMesher& mesher;
        scene::TriangleDraw triangles;   ///< GroundMesher::triangles before facing
        bool is_front_to_back = false;   ///< whether the nearest triangles come first
        bool has_light_in_alpha = false; ///< whether the alpha of its colours is the light that is left there
    };

    /// Forgets the last frame. The corners of pieces go to `vertices` and are numbered on after the ground's.
    void begin(const Ground& ground, std::vector<models::ColourVertex>& vertices);

    /// Lays what is seen of a decoration, on the nearest triangles first: all patches that are required, and others
    /// while they have at most so many triangles.
    void lay(nature::GroundDecoration& decoration, int max_triangles);

    /// Casts the shadow of an aircraft inside `hull`, unless it is under 2 pixels or out of view, or the sun is so low
    /// that shadows would be longer than 19 heights. `to_sun`: unit vector, world axes.
    void cast(const PlacedAircraft& aircraft, const OrientedBox& hull, const glm::dvec3& to_sun);

    /// The ground with all pieces since begin(); valid until the next call of another member.
    GroundFrame finish();

    std::span<const GroundDecal> decals() const;

    /// The corners of a decal, world axes with the eye subtracted, counter-clockwise seen from above.
    std::span<const glm::dvec3> corners_of(const GroundDecal& decal) const;

    /// Triangles of all decals.
    int decal_triangles() const;

private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

} // namespace octant::visuals::planning
