#pragma once

#include "models/measure/plane_frame.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace octant::models::simplify {

/// A point of the original surface.
struct OriginalPoint {
    std::array<float, 3> place{};
    std::uint32_t triangle = none; ///< That it lies on.
};

/// The surface that is approximated, in working units, for nearest points near a known one.
class OriginalSurface {
public:
    explicit OriginalSurface(const WorkingSurface& surface);

    /// A point of the surface that is nearer than all around it, found by going from triangle to
    /// triangle, from `start` on, as long as that leads nearer. So the side of a thin part stays
    /// the same. The squared distance goes to `distance2`.
    OriginalPoint nearest_from(std::uint32_t start, const glm::dvec3& point, double& distance2) const;

    /// The normal of a triangle, of any length.
    glm::dvec3 normal(std::uint32_t triangle) const;

    /// The squared distance to a triangle.
    double distance2(std::uint32_t triangle, const glm::dvec3& point) const {
        return nearest_on(triangle, point).distance2;
    }

    const std::vector<glm::dvec3>& places() const { return places_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }

    /// The triangle beyond each side of a triangle, or none.
    const std::array<std::uint32_t, 3>& beyond(std::uint32_t triangle) const {
        return beyond_[triangle];
    }

private:
    /// The nearest point of a triangle, and which of its sides or corners it lies on.
    struct OnTriangle {
        glm::dvec3 place{0.0};
        double distance2 = 0.0;
        std::uint32_t side = none;   ///< From this corner to the next one; none = inside.
        std::uint32_t corner = none; ///< This one; `side` is none then.
    };

    OnTriangle nearest_on(std::uint32_t triangle, const glm::dvec3& point) const;

    std::vector<glm::dvec3> places_;
    std::vector<Triangle> triangles_;
    std::vector<std::array<std::uint32_t, 3>> beyond_; ///< The triangle beyond each side, or none.
};

} // namespace octant::models::simplify
