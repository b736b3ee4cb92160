// Made for comparisons of simplifiers on shapes with sharp edges: rings of as many points each, from one pole to the
// other, so that the mesh is closed.

#include "models/procedural/machined_part.h"

#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace octant::models::procedural {

namespace {

using Outline = std::vector<glm::dvec2>; ///< counter-clockwise; seen from the origin all of it

constexpr double step_m = 0.00125; ///< along the outline, about

std::size_t steps_along(double length_m) { return static_cast<std::size_t>(std::lround(length_m / step_m)); }

/// Adds the points of a line but for its end.
void add_line(Outline& outline, const glm::dvec2& start, const glm::dvec2& end) {
    const std::size_t steps = steps_along(glm::distance(start, end));
    for (std::size_t i = 0; i < steps; ++i) {
        outline.push_back(glm::mix(start, end, static_cast<double>(i) / static_cast<double>(steps)));
    }
}

/// Points of a part of a circle without its end.
void add_arc(Outline& outline, const glm::dvec2& middle, double radius_m, double from_rad, double to_rad) {
    const std::size_t steps = steps_along(std::abs(to_rad - from_rad) * radius_m);
    for (std::size_t i = 0; i < steps; ++i) {
        const double angle = from_rad + (to_rad - from_rad) * static_cast<double>(i) / static_cast<double>(steps);
        outline.push_back(middle + radius_m * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
}

/// The outline of the block: a rounded corner, a step and a hollow.
Outline block_outline() {
    constexpr double quarter = std::numbers::pi / 2.0;
    Outline outline;
    add_line(outline, {0.040, -0.025}, {0.040, 0.010});
    add_arc(outline, {0.025, 0.010}, 0.015, 0.0, quarter);
    add_line(outline, {0.025, 0.025}, {-0.005, 0.025});
    add_line(outline, {-0.005, 0.025}, {-0.010, 0.017});
    add_line(outline, {-0.010, 0.017}, {-0.028, 0.017});
    add_arc(outline, {-0.040, 0.017}, 0.012, 0.0, -quarter);
    add_line(outline, {-0.040, 0.005}, {-0.040, -0.025});
    add_line(outline, {-0.040, -0.025}, {0.040, -0.025});
    return outline;
}

Outline scaled(const Outline& outline, double factor) {
    Outline made;
    for (const glm::dvec2& point : outline) { made.push_back(factor * point); }
    return made;
}

/// The same directions from the origin, all at one distance.
Outline circle(const Outline& outline, double radius_m) {
    Outline made;
    for (const glm::dvec2& point : outline) { made.push_back(radius_m * glm::normalize(point)); }
    return made;
}

/// The frame of a ring, which lies in its x-y plane.
struct Frame {
    glm::dvec3 origin{0.0};
    glm::dvec3 x{1.0, 0.0, 0.0};
    glm::dvec3 y{0.0, 1.0, 0.0};
    glm::dvec3 z{0.0, 0.0, 1.0};
};

class Rings {
public:
    explicit Rings(Outline outline) : outline_(std::move(outline)) {
        mesh_.name = "machined part";
        mesh_.vertices_m.push_back(frame_.origin);
    }

    /// In so many steps to another outline, so far on.
    void go(int steps, const Outline& to, double way_m) {
        const Outline from = outline_;
        const glm::dvec3 start = frame_.origin;
        for (int step = 1; step <= steps; ++step) {
            const double share = static_cast<double>(step) / steps;
            frame_.origin = start + share * way_m * frame_.z;
            for (std::size_t i = 0; i < from.size(); ++i) { outline_[i] = glm::mix(from[i], to[i], share); }
            add_ring();
        }
    }

    /// Around an axis along y that lies so far off along x.
    void bend(int steps, double radius_m, double angle_rad) {
        const Frame start = frame_;
        const glm::dvec3 axis = start.origin + radius_m * start.x;
        for (int step = 1; step <= steps; ++step) {
            const double angle = angle_rad * step / steps;
            frame_.x = std::cos(angle) * start.x - std::sin(angle) * start.z;
            frame_.z = std::sin(angle) * start.x + std::cos(angle) * start.z;
            frame_.origin = axis - radius_m * frame_.x;
            add_ring();
        }
    }

    /// Ends the mesh in a point so far ahead and returns it.
    TriangleMesh end(double way_m) {
        mesh_.vertices_m.push_back(frame_.origin + way_m * frame_.z);
        join_to_pole(mesh_.vertices_m.size() - 1);
        return std::move(mesh_);
    }

    const Outline& outline() const { return outline_; }

private:
    std::uint32_t number(std::size_t ring, std::size_t i) const {
        return static_cast<std::uint32_t>(1 + ring * outline_.size() + i % outline_.size());
    }

    void add_ring() {
        for (const glm::dvec2& point : outline_) {
            mesh_.vertices_m.push_back(frame_.origin + point.x * frame_.x + point.y * frame_.y);
        }
        const std::size_t ring = rings_++;
        for (std::size_t i = 0; i < outline_.size(); ++i) {
            if (ring == 0) {
                mesh_.triangles.push_back({0, number(0, i + 1), number(0, i)});
                continue;
            }
            const std::uint32_t a = number(ring - 1, i);
            const std::uint32_t b = number(ring - 1, i + 1);
            const std::uint32_t c = number(ring, i + 1);
            const std::uint32_t d = number(ring, i);
            if ((ring + i) % 2 == 0) {
                mesh_.triangles.insert(mesh_.triangles.end(), {{a, b, c}, {a, c, d}});
            } else {
                mesh_.triangles.insert(mesh_.triangles.end(), {{a, b, d}, {b, c, d}});
            }
        }
    }

    void join_to_pole(std::size_t pole) {
        for (std::size_t i = 0; i < outline_.size(); ++i) {
            mesh_.triangles.push_back(
                {number(rings_ - 1, i), number(rings_ - 1, i + 1), static_cast<std::uint32_t>(pole)});
        }
    }

    Outline outline_;
    Frame frame_;
    TriangleMesh mesh_;
    std::size_t rings_ = 0;
};

} // namespace

TriangleMesh machined_part() {
    const Outline block = block_outline();
    const Outline narrow = scaled(block, 0.9);
    Rings rings(scaled(block, 0.0));
    rings.go(9, block, 0.0);
    rings.go(20, narrow, 0.030);
    rings.bend(24, 0.060, rad_from_deg(50.0));
    rings.go(8, narrow, 0.012);
    rings.go(8, circle(block, 0.012), 0.0);    // the end around the boss
    rings.go(6, circle(block, 0.012), 0.006);  // the boss
    rings.go(2, circle(block, 0.010), 0.0015); // its chamfer
    rings.go(2, circle(block, 0.006), 0.0);
    rings.go(9, circle(block, 0.006), -0.012); // the bore
    rings.go(3, circle(block, 0.0015), -0.002);
    return rings.end(-0.0005);
}

} // namespace octant::models::procedural
