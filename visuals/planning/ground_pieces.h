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

/// An opaque convex polygon of one colour, without detail pattern or texture, inside a triangle of the ground and in
/// its plane.
struct GroundDecal {
    std::uint32_t triangle = 0; ///< Its number in GroundMesher::triangles().
    std::uint32_t first = 0;    ///< The index of its first corner.
    std::uint32_t count = 0;
    std::uint32_t colour = 0;
    GroundLayer layer = GroundLayer::Surface;
    models::SurfaceClass surface = models::SurfaceClass::Road;
};

/// Makes the pieces that lie on the ground of a frame, each cut to one triangle of the ground: decals of decorations,
/// and shadows of aircraft on the ground and on the decals. Calls for each frame: begin(), all lay(), all cast(),
/// finish().
class GroundPieces {
public:
    GroundPieces();
    GroundPieces(const GroundPieces&) = delete;
    GroundPieces& operator=(const GroundPieces&) = delete;
    GroundPieces(GroundPieces&&) = delete;
    GroundPieces& operator=(GroundPieces&&) = delete;
    ~GroundPieces();

    /// The ground of a frame. All members must stay until the next begin().
    struct Ground {
        const FrameView& view;
        const landscape::GroundMesher& mesher;
        scene::TriangleDraw triangles;   ///< All of GroundMesher::triangles(), whichever way they face.
        bool is_front_to_back = false;   ///< Whether the nearest triangles come first.
        bool has_light_in_alpha = false; ///< Whether the alpha of its colours is the light that reaches them.
        scene::WaterSurface water{};
    };

    /// Forgets the last frame. The corners of pieces are written to `vertices`; their numbers follow those of the
    /// ground's vertices. `surfaces` gets for each of them what the piece lies on, or is.
    void begin(
        const Ground& ground, std::vector<models::ColourVertex>& vertices, std::vector<models::SurfaceClass>& surfaces);

    /// Adds the visible decals of a decoration, on the nearest triangles first: all required patches, and others while
    /// the decals have at most `max_triangles`.
    void lay(nature::GroundDecoration& decoration, int max_triangles);

    /// Adds the shadow of an aircraft inside the box `hull`, unless it is smaller than 2 pixels or out of view, or the
    /// sun is so low that shadows would be longer than 19 heights. `to_sun`: unit vector, world axes. The far model
    /// casts it where the error of its shadow is at most `max_error_px`.
    void cast(const PlacedAircraft& aircraft, const OrientedBox& hull, const glm::dvec3& to_sun, double max_error_px);

    /// The ground with all pieces since begin(); valid until the next call of another member.
    GroundFrame finish();

    std::span<const GroundDecal> decals() const;

    /// The corners of a decal, world axes with the eye subtracted, counter-clockwise seen from above.
    std::span<const glm::dvec3> corners_of(const GroundDecal& decal) const;

    /// The number of triangles of all decals.
    int decal_triangles() const;

private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

} // namespace octant::visuals::planning
