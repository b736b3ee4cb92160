#pragma once

#include "visuals/raster/frame_draws.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/truth.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::raster {

/// What the pixels that show one triangle have in common.
struct SeenSurface {
    /// One over the depth at a column and row: x + y * column + z * row.
    glm::dvec3 inverse_depth{0.0};
    /// The depths of the nearest and of the farthest corner: rounding of corners may show a steep plane beyond its own
    /// triangle.
    double min_depth_m = 0.0;
    double max_depth_m = 0.0;
    glm::vec3 normal{0.0F};
    scene::SurfaceClass surface = scene::SurfaceClass::Sky;
    std::uint32_t object = 0;
    /// Takes 1, column and row to the place in the previous picture: column * w, row * w, w.
    glm::dmat3 to_previous{0.0};

    double inverse_depth_at(const glm::dvec2& at_px) const {
        return inverse_depth.x + inverse_depth.y * at_px.x + inverse_depth.z * at_px.y;
    }
};

/// The planes of a picture's triangles, and what pixels say of them.
class TruthSurfaces {
public:
    /// The plan and the draws must stay while it is used.
    void begin(const scene::FramePlan& plan, const FrameDraws& draws, const glm::ivec2& size_px, bool has_flow);

    /// Of the triangle that Triangle::source names.
    SeenSurface surface(std::uint32_t source) const;

    /// Of pixels that show no triangle.
    SeenSurface nothing() const;

    /// The class of a triangle and its object, as one number.
    std::uint32_t key(std::uint32_t source) const;

    static std::uint32_t key(const SeenSurface& seen) {
        return static_cast<std::uint32_t>(seen.surface) | seen.object << 8U;
    }

    /// Writes all that is wanted but the coverage of pixels `first` to `first + count - 1` of the arrays. They show
    /// places `at_px` and so on, each a column further right.
    void write(const SeenSurface& seen, const glm::dvec2& at_px, std::size_t first, std::size_t count,
        const scene::TruthArrays& to) const;

    /// The same of a pixel outside the picture, of which nothing is known.
    static void write_unknown(std::size_t pixel, const scene::TruthArrays& to);

private:
    /// The way of points from picture to picture.
    struct Motion {
        glm::dmat3 turn{1.0};
        glm::dvec3 shift_m{0.0};
    };

    void set_plane(const std::array<glm::dvec3, 3>& corners_m, SeenSurface& seen) const;
    void set_previous(const Motion& motion, SeenSurface& seen) const;
    glm::dvec3 on_clouds(const glm::vec2& at_px) const;
    glm::dvec3 ray(const glm::dvec2& at_px) const { return rays_[0] + rays_[1] * at_px.x + rays_[2] * at_px.y; }

    const scene::FramePlan* plan_ = nullptr;
    const FrameDraws* draws_ = nullptr;
    /// Takes 1, column and row to the way from the eye, of depth 1.
    glm::dmat3 rays_{0.0};
    glm::dvec3 ahead_{0.0};
    bool has_flow_ = false;
    /// Takes places, with the previous eye subtracted, to column * w, row * w, w.
    glm::dmat3 previous_from_world_{0.0};
    glm::dmat3 previous_from_still_{0.0}; ///< previous_from_world_ * rays_
    std::vector<Motion> motions_;         ///< of each of the plan's parts
};

} // namespace octant::visuals::raster
