#include "overlay_ink.h"

#include <array>
#include <optional>

namespace octant::tests {

namespace {

using visuals::scene::OverlayVertex;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double alpha_of(const OverlayVertex& vertex) { return (vertex.colour >> 24U) / 255.0; }

bool is_green(const OverlayVertex& vertex) { return ((vertex.colour >> 8U) & 255U) > 128U; }

std::optional<double> alpha_at(const std::array<OverlayVertex, 3>& corners, const glm::dvec2& at_px) {
    std::array<glm::dvec2, 3> to_corner;
    for (std::size_t i = 0; i < 3; ++i) { to_corner[i] = glm::dvec2(corners[i].at_px) - at_px; }
    std::array<double, 3> shares{};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        shares[i] = cross(to_corner[(i + 1) % 3], to_corner[(i + 2) % 3]);
        sum += shares[i];
    }
    double alpha = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (sum == 0.0 || shares[i] / sum < -1e-9) { return std::nullopt; }
        alpha += shares[i] / sum * alpha_of(corners[i]);
    }
    return alpha;
}

} // namespace

double ink_at(const visuals::scene::OverlayDraw& draw, const glm::vec2& at_px, bool green) {
    double ink = 0.0;
    for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
        const std::array<OverlayVertex, 3> corners{
            draw.vertices[draw.indices[i]], draw.vertices[draw.indices[i + 1]], draw.vertices[draw.indices[i + 2]]};
        if (is_green(corners[0]) == green) { ink = alpha_at(corners, glm::dvec2(at_px)).value_or(ink); }
    }
    return ink;
}

} // namespace octant::tests
