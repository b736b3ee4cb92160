#pragma once

#include "visuals/shading/shaded_polygons.h"
#include "visuals/shading/shading_rule.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace octant::ui::studies {

/// Light as it reaches the eye, red + green + blue in display values, not cut off: a square picture, top row first.
/// What no polygon covers is 0.
struct LightPicture {
    int size_px = 0;
    std::vector<float> light;
};

/// Draws a model again and again from one place: what is seen in each pixel is found once, exactly at the pixel's
/// centre and without GL; shading is then looked up.
class ShadingPictures {
public:
    /// An eye outside the model, not straight above or below, that looks at its middle, so that it fills the picture.
    /// `polygons` stay where they are as long as this.
    ShadingPictures(const visuals::shading::ShadedPolygons& polygons, const visuals::shading::ShadingLight& light,
        const glm::dvec3& eye_m, int size_px);

    /// Polygons marked in `smooth` with the light of their corners between them (Gouraud), the others with that at
    /// their middle.
    LightPicture hybrid(std::span<const std::uint8_t> smooth) const;

    /// Normals between corners, light in each pixel (Phong).
    LightPicture per_pixel() const;

    /// One a pixel: 1 where a polygon is seen.
    const std::vector<std::uint8_t>& covered() const { return covered_; }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    struct VisiblePoint {
        std::uint32_t polygon = none;
        std::array<std::uint32_t, 3> points{}; ///< corners of the fan's triangle
        std::array<float, 3> weights{};        ///< of the corners there, on the surface
    };

    struct ProjectedPoint {
        double x_px = 0.0;
        double y_px = 0.0;
        double nearness = 0.0; ///< 1 / depth
    };

    std::vector<ProjectedPoint> project() const;
    void draw_triangle(
        std::uint32_t polygon, const std::array<std::uint32_t, 3>& points, std::span<const ProjectedPoint> screen);

    const visuals::shading::ShadedPolygons* polygons_;
    visuals::shading::ShadingLight light_;
    glm::vec3 eye_m_;
    int size_px_;
    std::vector<VisiblePoint> seen_;
    std::vector<double> nearness_;
    std::vector<std::uint8_t> covered_;
    std::vector<float> smooth_light_; ///< one a point
    std::vector<float> flat_light_;   ///< one a polygon
};

/// What a screen shows as white: red + green + blue.
inline constexpr double white_light = 3.0;

/// Mean square of the difference over the covered pixels; 0 where nothing is covered.
double mean_square_error(
    const LightPicture& picture, const LightPicture& reference, std::span<const std::uint8_t> covered);

/// Peak signal to noise in decibels of white_light, infinite where the error is 0.
double psnr_db(double mean_square);

/// Structural similarity (Wang et al. 2004) of square windows of 7 x 7 pixels, covered ones only, averaged over all
/// covered pixels as middles: K1 = 0.01, K2 = 0.03, range white_light. 1 = equal.
double structural_similarity(
    const LightPicture& picture, const LightPicture& reference, std::span<const std::uint8_t> covered);

} // namespace octant::ui::studies
