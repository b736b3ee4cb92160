#pragma once

#include "visuals/parting/pieces.h"

#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::parting {

/// Some pieces with their bounding spheres and corners side by side in memory, for questions that
/// are asked of all of them.
class PieceTable {
public:
    /// Every `step`th of `items`, from the first one.
    PieceTable(const Pieces& pieces, std::span<const std::uint32_t> items, std::size_t step = 1);

    std::size_t count() const { return balls_.size(); }

    /// Pieces::reach() of the piece in place `i`.
    Reach reach(std::size_t i, const Plane& plane) const {
        const Ball& ball = balls_[i];
        const double height = distance_m(plane, ball.middle);
        if (std::abs(height) > ball.radius) {
            return {height > 0.0, height < 0.0};
        }
        Reach reach;
        for (std::size_t k = ball.first_corner; k < ball.end_corner; ++k) {
            const double at_corner = distance_m(plane, corners_[k]);
            reach.before = reach.before || at_corner > tolerance;
            reach.behind = reach.behind || at_corner < -tolerance;
        }
        return reach;
    }

private:
    struct Ball {
        glm::dvec3 middle{0.0};
        double radius = 0.0; ///< and the tolerance
        std::size_t first_corner = 0;
        std::size_t end_corner = 0;
    };

    std::vector<Ball> balls_;
    std::vector<glm::dvec3> corners_;
};

} // namespace octant::visuals::parting
