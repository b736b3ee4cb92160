#include "ui/commands/model_picture.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace octant::ui::commands {

namespace {

constexpr int samples_a_side = 2; ///< Of a pixel.
constexpr glm::vec3 background_colour(0.93F, 0.94F, 0.96F);

/// The directions on the screen, body axes. `towards` points to the eye.
struct View {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 towards;
};

constexpr std::array views{
    View{{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    View{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
    View{{0, -1, 0}, {0, 0, -1}, {1, 0, 0}}};

/// Samples of one view, the nearest surface at each.
class Pane {
public:
    Pane(int width, int height)
        : width_(width)
        , height_(height)
        , depths_(cells(), -std::numeric_limits<double>::infinity())
        , colours_(cells(), background_colour) {}

    /// Corners: x and y in samples from the upper left corner, z towards the eye.
    void draw(const std::array<glm::dvec3, 3>& corners, const glm::vec3& colour) {
        const auto [a, b, c] = corners;
        const double area = cross(b - a, c - a);
        if (area == 0.0) {
            return;
        }
        const int first_x = clamped(std::min({a.x, b.x, c.x}), width_);
        const int last_x = clamped(std::max({a.x, b.x, c.x}), width_);
        const int first_y = clamped(std::min({a.y, b.y, c.y}), height_);
        const int last_y = clamped(std::max({a.y, b.y, c.y}), height_);
        for (int y = first_y; y <= last_y; ++y) {
            for (int x = first_x; x <= last_x; ++x) {
                const glm::dvec3 p(x + 0.5, y + 0.5, 0.0);
                const double u = cross(c - b, p - b) / area;
                const double v = cross(a - c, p - c) / area;
                const double w = 1.0 - u - v;
                if (u >= 0.0 && v >= 0.0 && w >= 0.0) {
                    put(x, y, u * a.z + v * b.z + w * c.z, colour);
                }
            }
        }
    }

    /// The mean of a pixel's samples.
    glm::vec3 pixel(int x, int y) const {
        glm::vec3 sum(0.0F);
        for (int j = 0; j < samples_a_side; ++j) {
            for (int i = 0; i < samples_a_side; ++i) {
                sum += colours_[index(x * samples_a_side + i, y * samples_a_side + j)];
            }
        }
        return sum / static_cast<float>(samples_a_side * samples_a_side);
    }

private:
    std::size_t cells() const {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    static int clamped(double place, int size) {
        return static_cast<int>(std::clamp(std::floor(place), 0.0, size - 1.0));
    }

    static double cross(const glm::dvec3& one, const glm::dvec3& other) {
        return one.x * other.y - one.y * other.x;
    }

    void put(int x, int y, double depth, const glm::vec3& colour) {
        if (depth > depths_[index(x, y)]) {
            depths_[index(x, y)] = depth;
            colours_[index(x, y)] = colour;
        }
    }

    int width_;
    int height_;
    std::vector<double> depths_;
    std::vector<glm::vec3> colours_;
};

/// Where a mesh comes to lie in the panes: its middle in theirs, at one scale for all.
struct FittedScale {
    glm::dvec3 middle_m{0.0};
    double samples_per_m = 1.0;
};

FittedScale fitted_scale_of(const models::TriangleMesh& body, double width, double height) {
    constexpr double share = 0.92;
    const models::BoundingBox bounds = models::bounds_of(body);
    const glm::dvec3 extent_m = bounds.max_m - bounds.min_m;
    double scale = std::numeric_limits<double>::infinity();
    for (const View& view : views) {
        const double across_m = std::abs(glm::dot(extent_m, view.right));
        const double up_m = std::abs(glm::dot(extent_m, view.up));
        scale = across_m > 0.0 ? std::min(scale, share * width / across_m) : scale;
        scale = up_m > 0.0 ? std::min(scale, share * height / up_m) : scale;
    }
    return {0.5 * (bounds.min_m + bounds.max_m), std::isfinite(scale) ? scale : 1.0};
}

Pane pane_of(const models::TriangleMesh& body, const View& view, int width, int height) {
    Pane pane(width, height);
    const FittedScale fit = fitted_scale_of(body, width, height);
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 off_m = body.vertices_m[body.triangles[t][k]] - fit.middle_m;
            corners.at(k) = glm::dvec3(
                0.5 * width + fit.samples_per_m * glm::dot(off_m, view.right),
                0.5 * height - fit.samples_per_m * glm::dot(off_m, view.up),
                glm::dot(off_m, view.towards));
        }
        const double facing = glm::dot(models::normal_of(body, body.triangles[t]), view.towards);
        const double light = (facing < 0.0 ? 0.5 : 1.0) * (0.3 + 0.7 * std::abs(facing));
        pane.draw(corners, models::mean_colour(body, t) * static_cast<float>(light));
    }
    return pane;
}

std::byte byte_of(float part) {
    return static_cast<std::byte>(std::lround(std::clamp(part, 0.0F, 1.0F) * 255.0F));
}

} // namespace

report::Picture three_views(const models::TriangleMesh& body, int pane_width_px, int height_px) {
    const int panes = static_cast<int>(views.size());
    report::Picture picture{pane_width_px * panes, height_px, 3, {}};
    picture.bytes.resize(
        static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(height_px) * 3);
    for (int number = 0; number < panes; ++number) {
        const Pane pane = pane_of(
            body,
            views.at(static_cast<std::size_t>(number)),
            pane_width_px * samples_a_side,
            height_px * samples_a_side);
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < pane_width_px; ++x) {
                const glm::vec3 colour = pane.pixel(x, y);
                const int column = number * pane_width_px + x;
                const std::size_t at = 3 * static_cast<std::size_t>(y * picture.width_px + column);
                for (int part = 0; part < 3; ++part) {
                    picture.bytes[at + static_cast<std::size_t>(part)] = byte_of(colour[part]);
                }
            }
        }
    }
    return picture;
}

} // namespace octant::ui::commands
