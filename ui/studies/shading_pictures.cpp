#include "ui/studies/shading_pictures.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace octant::ui::studies {

namespace shading = visuals::shading;

ShadingPictures::ShadingPictures(
    const shading::ShadedPolygons& polygons, const shading::ShadingLight& light, const glm::dvec3& eye_m, int size_px)
    : polygons_(&polygons), light_(light), eye_m_(eye_m), size_px_(size_px) {
    const auto pixels = static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px);
    seen_.resize(pixels);
    nearness_.assign(pixels, 0.0);
    for (const shading::ShadingPoint& point : polygons.points) {
        smooth_light_.push_back(shading::intensity(point.place_m, point.normal, point.colour_sum, light, eye_m_));
    }
    const std::vector<ProjectedPoint> screen = project();
    for (std::uint32_t i = 0; i < polygons.size(); ++i) {
        const shading::ShadedPolygon& shape = polygons.polygons[i];
        flat_light_.push_back(shading::intensity(shape.centre_m, shape.normal, shape.colour_sum, light, eye_m_));
        if (glm::dot(shape.normal, eye_m_ - shape.centre_m) <= 0.0F) { continue; }
        const std::uint32_t* const points = &polygons.corner_points[shape.first_corner];
        for (std::uint32_t k = 1; k + 1 < shape.corner_count; ++k) {
            draw_triangle(i, {points[0], points[k], points[k + 1]}, screen);
        }
    }
    for (const VisiblePoint& seen : seen_) { covered_.push_back(seen.polygon == none ? 0 : 1); }
}

std::vector<ShadingPictures::ProjectedPoint> ShadingPictures::project() const {
    const glm::dvec3 middle_m(polygons_->centre_m);
    const glm::dvec3 eye_m(eye_m_);
    const double distance_m = glm::distance(eye_m, middle_m);
    assert(distance_m > polygons_->radius_m);
    const glm::dvec3 ahead = (middle_m - eye_m) / distance_m;
    const glm::dvec3 down(0.0, 0.0, 1.0); // body axes
    const glm::dvec3 right = glm::normalize(glm::cross(down, ahead));
    const glm::dvec3 below = glm::cross(ahead, right);
    std::vector<ProjectedPoint> screen;
    double widest = 0.0;
    for (const shading::ShadingPoint& point : polygons_->points) {
        const glm::dvec3 from_eye_m = glm::dvec3(point.place_m) - eye_m;
        const double depth_m = glm::dot(from_eye_m, ahead);
        screen.push_back({glm::dot(from_eye_m, right) / depth_m, glm::dot(from_eye_m, below) / depth_m, 1.0 / depth_m});
        widest = std::max({widest, std::abs(screen.back().x_px), std::abs(screen.back().y_px)});
    }
    const double half_px = 0.5 * size_px_;
    const double scale_px = 0.97 * half_px / widest;
    for (ProjectedPoint& point : screen) {
        point.x_px = half_px + scale_px * point.x_px;
        point.y_px = half_px + scale_px * point.y_px;
    }
    return screen;
}

void ShadingPictures::draw_triangle(
    std::uint32_t polygon, const std::array<std::uint32_t, 3>& points, std::span<const ProjectedPoint> screen) {
    const ProjectedPoint& a = screen[points[0]];
    const ProjectedPoint& b = screen[points[1]];
    const ProjectedPoint& c = screen[points[2]];
    const auto doubled = [](const ProjectedPoint& one, const ProjectedPoint& two, double x_px, double y_px) {
        return (two.x_px - one.x_px) * (y_px - one.y_px) - (two.y_px - one.y_px) * (x_px - one.x_px);
    };
    const double whole = doubled(a, b, c.x_px, c.y_px);
    if (whole == 0.0) { return; }
    const auto pixel = [&](double place_px) {
        return static_cast<int>(std::clamp(std::ceil(place_px - 0.5), 0.0, double(size_px_)));
    };
    const auto [left_px, right_px] = std::minmax({a.x_px, b.x_px, c.x_px});
    const auto [top_px, bottom_px] = std::minmax({a.y_px, b.y_px, c.y_px});
    for (int row = pixel(top_px); row < pixel(bottom_px + 1.0); ++row) {
        for (int column = pixel(left_px); column < pixel(right_px + 1.0); ++column) {
            const double of_a = doubled(b, c, column + 0.5, row + 0.5) / whole;
            const double of_b = doubled(c, a, column + 0.5, row + 0.5) / whole;
            const double of_c = 1.0 - of_a - of_b;
            const auto at =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(size_px_) + static_cast<std::size_t>(column);
            if (row >= size_px_ || column >= size_px_ || of_a < 0.0 || of_b < 0.0 || of_c < 0.0) { continue; }
            const double nearness = of_a * a.nearness + of_b * b.nearness + of_c * c.nearness;
            if (nearness > nearness_[at]) {
                nearness_[at] = nearness;
                seen_[at] = {polygon, points,
                    {static_cast<float>(of_a * a.nearness / nearness), static_cast<float>(of_b * b.nearness / nearness),
                        static_cast<float>(of_c * c.nearness / nearness)}};
            }
        }
    }
}

LightPicture ShadingPictures::hybrid(std::span<const std::uint8_t> smooth) const {
    assert(smooth.size() == polygons_->size());
    LightPicture picture{size_px_, std::vector<float>(seen_.size())};
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        const VisiblePoint& seen = seen_[i];
        if (seen.polygon == none) { continue; }
        picture.light[i] = flat_light_[seen.polygon];
        if (smooth[seen.polygon] != 0) {
            picture.light[i] = seen.weights[0] * smooth_light_[seen.points[0]] +
                               seen.weights[1] * smooth_light_[seen.points[1]] +
                               seen.weights[2] * smooth_light_[seen.points[2]];
        }
    }
    return picture;
}

LightPicture ShadingPictures::per_pixel() const {
    LightPicture picture{size_px_, std::vector<float>(seen_.size())};
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        const VisiblePoint& seen = seen_[i];
        if (seen.polygon == none) { continue; }
        glm::vec3 place_m(0.0F);
        glm::vec3 normal(0.0F);
        float colour_sum = 0.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            const shading::ShadingPoint& point = polygons_->points[seen.points[k]];
            place_m += seen.weights[k] * point.place_m;
            normal += seen.weights[k] * point.normal;
            colour_sum += seen.weights[k] * point.colour_sum;
        }
        picture.light[i] = shading::intensity(place_m, glm::normalize(normal), colour_sum, light_, eye_m_);
    }
    return picture;
}

// Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From Error Visibility to Structural
// Similarity", IEEE Trans. Image Processing 13 (4), 2004, equation (13). Deviations: even windows of 7 x 7 instead of a
// bell of 11 x 11, and only what is covered counts.

namespace {

constexpr int reach_px = 3;

/// Sums over windows: pixels, x, y, x^2, y^2, x y.
using Sums = std::array<double, 6>;

void add(Sums& sums, const Sums& more, double sign = 1.0) {
    for (std::size_t k = 0; k < sums.size(); ++k) { sums[k] += sign * more[k]; }
}

Sums sums_of_pixel(double x, double y) { return {1.0, x, y, x * x, y * y, x * y}; }

/// Sums over all pixels above and left of each corner of the pixels.
std::vector<Sums> running_sums(
    const LightPicture& picture, const LightPicture& reference, std::span<const std::uint8_t> covered) {
    const auto size = static_cast<std::size_t>(picture.size_px);
    std::vector<Sums> sums((size + 1) * (size + 1), Sums{});
    for (std::size_t row = 0; row < size; ++row) {
        Sums of_row{};
        for (std::size_t column = 0; column < size; ++column) {
            const std::size_t at = row * size + column;
            if (covered[at] != 0) { add(of_row, sums_of_pixel(picture.light[at], reference.light[at])); }
            Sums& below = sums[(row + 1) * (size + 1) + column + 1];
            below = sums[row * (size + 1) + column + 1];
            add(below, of_row);
        }
    }
    return sums;
}

double similarity(const Sums& sums) {
    const double small_mean = 0.01 * white_light * 0.01 * white_light;
    const double small_spread = 0.03 * white_light * 0.03 * white_light;
    const double x = sums[1] / sums[0];
    const double y = sums[2] / sums[0];
    const double xx = std::max(sums[3] / sums[0] - x * x, 0.0);
    const double yy = std::max(sums[4] / sums[0] - y * y, 0.0);
    const double xy = sums[5] / sums[0] - x * y;
    return (2.0 * x * y + small_mean) * (2.0 * xy + small_spread) /
           ((x * x + y * y + small_mean) * (xx + yy + small_spread));
}

} // namespace

double mean_square_error(
    const LightPicture& picture, const LightPicture& reference, std::span<const std::uint8_t> covered) {
    assert(picture.size_px == reference.size_px);
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
        if (covered[i] != 0) {
            const double error = double{picture.light[i]} - double{reference.light[i]};
            sum += error * error;
            ++count;
        }
    }
    return count > 0.0 ? sum / count : 0.0;
}

double psnr_db(double mean_square) {
    return mean_square > 0.0 ? 10.0 * std::log10(white_light * white_light / mean_square)
                             : std::numeric_limits<double>::infinity();
}

double structural_similarity(
    const LightPicture& picture, const LightPicture& reference, std::span<const std::uint8_t> covered) {
    assert(picture.size_px == reference.size_px);
    const int size = picture.size_px;
    const std::vector<Sums> sums = running_sums(picture, reference, covered);
    const auto sums_at = [&](int row, int column) -> const Sums& {
        return sums[static_cast<std::size_t>(row) * (static_cast<std::size_t>(size) + 1) +
                    static_cast<std::size_t>(column)];
    };
    double total = 0.0;
    double count = 0.0;
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            const auto at =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
            if (covered[at] == 0) { continue; }
            const int top = std::max(row - reach_px, 0);
            const int left = std::max(column - reach_px, 0);
            const int bottom = std::min(row + reach_px + 1, size);
            const int right = std::min(column + reach_px + 1, size);
            Sums window = sums_at(bottom, right);
            add(window, sums_at(top, right), -1.0);
            add(window, sums_at(bottom, left), -1.0);
            add(window, sums_at(top, left));
            total += similarity(window);
            ++count;
        }
    }
    return count > 0.0 ? total / count : 1.0;
}

} // namespace octant::ui::studies
