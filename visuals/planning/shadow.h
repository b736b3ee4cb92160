#pragma once

#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/planning/placed_aircraft.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// Share of a sunlit surface's colour that is left in a shadow.
inline constexpr float shadow_share = 0.55F;

/// Below this elevation of the sun there are no shadows: they would be longer than 19 heights.
inline constexpr double min_sun_elevation_deg = 3.0;

/// Shadows of aircraft: each polygon that faces the sun, thrown along the sunlight onto each triangle of the ground
/// below and cut off at the triangle's sides. The pieces are opaque and have the triangle's own colours, darkened, so
/// that pieces on pieces change nothing; what is painted on a triangle has shadows of its own. Light ends at the ground
/// it meets first; ground shadows no ground. Keeps its memory.
class ShadowCaster {
public:
    /// `to_sun`: unit vector, world axes.
    explicit ShadowCaster(const glm::dvec3& to_sun);

    /// Forgets the last frame. `triangles` are GroundMesher::triangles before facing; the pieces' corners go to
    /// `vertices` and are numbered on after the ground's. Where alpha is the light that is left, it is darkened, too.
    void begin(
        const scene::TriangleDraw& triangles, bool alpha_is_visibility, std::vector<models::ColourVertex>& vertices);

    /// Adds what is painted on the ground, on which later shadows fall. It stays where it is until the next begin().
    void set_decals(const GroundDecals& decals);

    /// Adds the shadow of an aircraft inside `hull`, unless it is under 2 pixels or out of view.
    void cast(const PlacedAircraft& aircraft, const OrientedBox& hull, const landscape::GroundMesher& ground,
        const FrameView& view);

    /// To be called after the last set_decals() and cast().
    void sort_pieces();

    /// The pieces laid and cast since begin(): by ascending ground triangle after sort_pieces().
    std::span<const ShadowPieces> pieces() const { return pieces_; }

    std::span<const std::uint32_t> indices() const { return indices_; }

private:
    struct Face {
        Plane plane;
        std::size_t first = 0;
        std::size_t count = 0;
    };

    double light_path_m(const OrientedBox& hull, const landscape::Ground& ground, const glm::dvec3& eye_m) const;
    void collect_faces(const PlacedAircraft& aircraft);
    void cast_on(std::uint32_t triangle);
    void add_piece(std::uint32_t triangle);
    void add_on_decals(std::uint32_t triangle);
    void add_pieces(std::uint32_t triangle, GroundLayer layer, std::size_t first);
    void add_fan(std::size_t corners);

    glm::dvec3 to_sun_;
    bool high_enough_;
    scene::TriangleDraw ground_;
    bool alpha_is_light_ = false;
    std::vector<models::ColourVertex>* vertices_ = nullptr;
    GroundDecals decals_;
    std::vector<std::uint32_t> decals_by_triangle_; ///< places in decals_
    std::vector<ShadowPieces> pieces_;
    std::vector<std::uint32_t> indices_;
    std::vector<std::uint32_t> candidates_;
    std::vector<Face> faces_;
    std::vector<ViewVertex> face_corners_;
    ViewPolygon triangle_;
    ViewPolygon part_;
    /// The shadows on one triangle's plane that meet it, not yet cut to it, one after the other, and where each ends.
    std::vector<ViewVertex> shadow_parts_;
    std::vector<std::size_t> shadow_ends_;
    ViewPolygon scratch_;
};

} // namespace octant::visuals::planning
