#pragma once

#include "ui/studies/draw_order/study_renderer.h"
#include "visuals/scene/frame_plan.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::ui::studies::draw_order {

/// Finds what the pixels of a plan show by a ray through the middle of each: every triangle in double precision, no
/// rounding of corners and no painting order. For plans of polygon numbers (planning::IdPlan) whose surfaces are hidden
/// by depth, which hold all triangles that may be seen. Clips and overlays are left out.
class RayRenderer final : public StudyRenderer {
public:
    explicit RayRenderer(const glm::ivec2& size_px);

    void load_models(std::span<const visuals::scene::ModelBuffers> models) override {
        models_.assign(models.begin(), models.end());
    }

    void draw(const visuals::scene::FramePlan& plan) override;

    void finish_and_read(visuals::scene::Picture& picture) override { picture = picture_; }

    /// A pixel that shows what no rounding of corners explains: no triangle of that number comes within reach of the
    /// pixel's middle, or all places within reach lie behind nearer ones.
    struct WrongPixel {
        glm::ivec2 at{0};
        std::uint32_t number = 0; ///< that it shows
        /// How much nearer what the ray finds is, as a share of the depth; nothing: what is shown is not within reach.
        std::optional<double> nearer;
    };

    struct Difference {
        long differing = 0; ///< pixels that show another number than their ray finds
        std::vector<WrongPixel> wrong;
    };

    /// Of another renderer's picture of the last plan, of the same size (asserted). A pixel's middle may lie `reach_px`
    /// from what it shows.
    Difference compare(const visuals::scene::Picture& picture, double reach_px) const;

    /// What a pixel shows.
    std::uint32_t number_of(const glm::ivec2& pixel) const;

    /// Of a plan painted in order: whether a pixel shows `number` only as each piece's corners are rounded for
    /// themselves, as where two polygons are cut by a plane that is seen edge-on. So it is if the pieces, painted
    /// without rounding, show `seen`, and sides of a piece of `number` and of all that are painted over it there are
    /// within reach of the pixel's middle.
    bool is_rounding(const glm::ivec2& pixel, std::uint32_t number, std::uint32_t seen, double reach_px) const;

private:
    /// A triangle as rays meet it. Values at a pixel (column, row, 1) are dot products.
    struct Target {
        std::array<glm::dvec3, 3> inwards; ///< how far inside each edge, pixels
        glm::dvec3 inverse_depth{0.0};     ///< one over the depth along the line of sight, 1/m
        double max_over_w = 0.0;           ///< within the triangle
        std::array<glm::dvec2, 3> corners_px{};
        bool is_placed = false; ///< all corners lie before the near plane: corners_px count
        glm::ivec2 least{0};    ///< pixels that it may cover, and one more on each side
        glm::ivec2 most{0};
        std::uint32_t number = 0;
        std::uint32_t piece = 0; ///< those of one polygon are the same, one after the other

        double inside_px(const glm::dvec3& at) const;
        double distance_px(const glm::dvec2& at) const;
    };

    void add(const std::array<glm::vec3, 3>& corners_m, std::uint32_t number, bool culls);
    static bool may_reach(const Target& target, const glm::ivec2& pixel, double reach_px);
    void add_ground(const visuals::scene::FramePlan& plan);
    void add_aircraft(const visuals::scene::FramePlan& plan, const visuals::scene::AircraftDraw& draw);
    void draw_target(const Target& target);
    std::optional<WrongPixel> wrong_pixel_at(const glm::ivec2& pixel, std::uint32_t number, double reach_px) const;

    glm::ivec2 size_px_;
    std::vector<visuals::scene::ModelBuffers> models_;
    glm::dmat4 world_to_clip_{1.0};
    double near_m_ = 0.0;
    std::vector<Target> targets_; ///< as the plan names them
    std::uint32_t pieces_ = 0;
    std::vector<double> inverse_depths_; ///< of what is seen in each pixel; 0: nothing
    visuals::scene::Picture picture_;
};

} // namespace octant::ui::studies::draw_order
