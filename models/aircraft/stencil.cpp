#include "models/aircraft/stencil.h"

#include "models/aircraft/convex_outline.h"
#include "sim/base/plane.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace octant::models::aircraft {

namespace {

Plane plane_at(const glm::dvec3& point_m, const glm::dvec3& normal) {
    const glm::dvec3 unit = glm::normalize(normal);
    return {unit, -glm::dot(unit, point_m)};
}

void add_piece(PaintedSolid& pieces, Outline corners, const std::string& material) {
    if (has_area(corners)) { pieces.push_back({std::move(corners), material}); }
}

} // namespace

void paint(PaintedSolid& solid, const Stencil& stencil, const std::string& material) {
    PaintedSolid out;
    for (PaintedFace& face : solid) {
        const glm::dvec3 normal = glm::normalize(area_vector(face.corners_m));
        if (stencil.facing != glm::dvec3(0.0) &&
            glm::dot(normal, glm::normalize(stencil.facing)) < stencil.min_cosine) {
            out.push_back(std::move(face));
            continue;
        }
        PaintedSolid outside;
        Outline inside = face.corners_m;
        for (const Plane& plane : stencil.planes) {
            add_piece(outside, in_front(inside, turned_over(plane)), face.material);
            inside = in_front(inside, plane);
            if (!has_area(inside)) { break; }
        }
        if (!has_area(inside)) {
            out.push_back(std::move(face));
            continue;
        }
        out.insert(out.end(), outside.begin(), outside.end());
        out.push_back({std::move(inside), material});
    }
    solid = std::move(out);
}

Stencil stripe(const glm::dvec3& point_m, const glm::dvec3& across, double width_m) {
    const glm::dvec3 half_m = 0.5 * width_m * glm::normalize(across);
    return {{plane_at(point_m - half_m, across), plane_at(point_m + half_m, -across)}};
}

Stencil outline(std::span<const glm::dvec2> corners_m, int axis) {
    const auto placed = [&](const glm::dvec2& at) {
        return axis == 0   ? glm::dvec3(0.0, at.x, at.y)
               : axis == 1 ? glm::dvec3(at.x, 0.0, at.y)
                           : glm::dvec3(at.x, at.y, 0.0);
    };
    glm::dvec2 middle(0.0);
    for (const glm::dvec2& corner : corners_m) { middle += corner / static_cast<double>(corners_m.size()); }
    Stencil stencil;
    for (std::size_t i = 0; i < corners_m.size(); ++i) {
        const glm::dvec2& from = corners_m[i];
        const glm::dvec2 along = corners_m[(i + 1) % corners_m.size()] - from;
        glm::dvec2 inward(-along.y, along.x);
        if (glm::dot(inward, middle - from) < 0.0) { inward = -inward; }
        stencil.planes.push_back(plane_at(placed(from), placed(inward)));
    }
    return stencil;
}

void paint_roundel(PaintedSolid& solid, const Roundel& roundel, const std::string& disc, const std::string& star) {
    const glm::dvec2 across(-roundel.to_top.y, roundel.to_top.x);
    const auto at = [&](double radius_share, double angle_rad) {
        return roundel.middle_m +
               roundel.radius_m * radius_share * (std::cos(angle_rad) * roundel.to_top + std::sin(angle_rad) * across);
    };
    const auto paint_shape = [&](std::span<const glm::dvec2> corners, const std::string& material) {
        Stencil stencil = outline(corners, roundel.axis);
        stencil.facing = roundel.facing;
        paint(solid, stencil, material);
    };
    std::array<glm::dvec2, 10> rim;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        rim[i] = at(1.0, 2.0 * pi * static_cast<double>(i) / double{rim.size()});
    }
    paint_shape(rim, disc);
    constexpr double inner = 0.381966; // of a star whose edges run on straight
    std::array<glm::dvec2, 5> core;
    for (int i = 0; i < 5; ++i) { core[static_cast<std::size_t>(i)] = at(inner * 0.92, 2.0 * pi * (i + 0.5) / 5.0); }
    paint_shape(core, star);
    for (int i = 0; i < 5; ++i) {
        const std::array<glm::dvec2, 3> point{at(0.92, 2.0 * pi * i / 5.0), core[static_cast<std::size_t>(i)],
            core[static_cast<std::size_t>((i + 4) % 5)]};
        paint_shape(point, star);
    }
}

} // namespace octant::models::aircraft
