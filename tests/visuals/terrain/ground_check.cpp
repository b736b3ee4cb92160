#include "tests/visuals/terrain/ground_check.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace octant::visuals::terrain::test {

namespace {

std::size_t sample_count(int columns, int rows) {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
}

struct Place {
    long column;
    long row;
};

Place place_of(std::uint32_t sample, const models::heights::HeightField& field) {
    return {static_cast<long>(sample) % field.columns(), static_cast<long>(sample) / field.columns()};
}

long twice_plan_area(const SampleTriangle& t, const models::heights::HeightField& field) {
    const Place a = place_of(t.a, field);
    const Place b = place_of(t.b, field);
    const Place c = place_of(t.c, field);
    return (b.column - a.column) * (c.row - a.row) - (b.row - a.row) * (c.column - a.column);
}

bool on_border(std::uint32_t a, std::uint32_t b, const models::heights::HeightField& field) {
    const Place p = place_of(a, field);
    const Place q = place_of(b, field);
    return (p.column == q.column && (p.column == 0 || p.column == field.columns() - 1)) ||
           (p.row == q.row && (p.row == 0 || p.row == field.rows() - 1));
}

/// Part of a plan ray, in lengths of its direction.
struct Passage {
    double first = 0.0;
    double last = std::numeric_limits<double>::infinity();
};

/// Where a ray from the origin is inside a counter-clockwise triangle, if it is for more than a moment.
std::optional<Passage> passage_through(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& direction) {
    Passage inside;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 edge = corners[(k + 1) % 3] - corners[k];
        const glm::dvec2 inward(-edge.y, edge.x);
        const double approach = glm::dot(inward, direction);
        const double way = glm::dot(inward, corners[k]);
        if (approach > 0.0) {
            inside.first = std::max(inside.first, way / approach);
        } else if (approach < 0.0) {
            inside.last = std::min(inside.last, way / approach);
        } else if (way >= 0.0) {
            return std::nullopt;
        }
    }
    constexpr double moment = 1e-7;
    return inside.last - inside.first > moment ? std::optional(inside) : std::nullopt;
}

/// Directions between each two neighbouring ones of those to the corners.
std::vector<glm::dvec2> directions_between(const std::vector<std::array<glm::dvec2, 3>>& triangles) {
    std::vector<double> angles_rad;
    for (const auto& corners : triangles) {
        for (const glm::dvec2& corner : corners) { angles_rad.push_back(std::atan2(corner.y, corner.x)); }
    }
    std::sort(angles_rad.begin(), angles_rad.end());
    if (!angles_rad.empty()) { angles_rad.push_back(angles_rad.front() + 2.0 * std::numbers::pi); }
    std::vector<glm::dvec2> directions;
    constexpr double min_gap_rad = 1e-7;
    for (std::size_t k = 1; k < angles_rad.size(); ++k) {
        if (angles_rad[k] - angles_rad[k - 1] > min_gap_rad) {
            const double middle_rad = 0.5 * (angles_rad[k] + angles_rad[k - 1]);
            directions.emplace_back(std::cos(middle_rad), std::sin(middle_rad));
        }
    }
    return directions;
}

} // namespace

SampleTriangle smallest_first(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a < b && a < c) { return {a, b, c}; }
    return b < c ? SampleTriangle{b, c, a} : SampleTriangle{c, a, b};
}

models::heights::HeightField level_field(int columns, int rows) {
    return {columns, rows, 1.0, std::vector<float>(sample_count(columns, rows), 0.0F)};
}

models::heights::HeightField bump_field(int size, int column, int row, float height_m) {
    std::vector<float> heights(sample_count(size, size), 0.0F);
    heights[static_cast<std::size_t>(row * size + column)] = height_m;
    return {size, size, 1.0, std::move(heights)};
}

models::heights::HeightField rough_field(int columns, int rows, std::uint64_t seed) {
    Numbers numbers(seed);
    const double wave = numbers.between(0.05, 0.5);
    const double high = numbers.between(0.1, 1.0);
    const double noise = numbers.between(0.0, 2.0);
    std::vector<float> heights;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double hills = 6.0 * std::sin(column * wave) * std::cos(row * wave * 0.7);
            const double patch = std::max(std::sin(column * 0.11 + row * 0.07), 0.0);
            heights.push_back(static_cast<float>(high * high * (hills + noise * patch * numbers.between(-1.0, 1.0))));
        }
    }
    return {columns, rows, 1.0, std::move(heights)};
}

models::heights::HeightField spiky_field(int columns, int rows, std::uint64_t seed) {
    Numbers numbers(seed);
    const std::uint32_t one_in = 1U << (4U + numbers.next() % 6U);
    std::vector<float> heights;
    for (std::size_t k = 0; k < sample_count(columns, rows); ++k) {
        const bool spike = numbers.next() % one_in == 0;
        heights.push_back(spike ? static_cast<float>(numbers.between(1.0, 15.0)) : 0.0F);
    }
    return {columns, rows, 1.0, std::move(heights)};
}

std::vector<std::uint32_t> numbered_colours(const models::heights::HeightField& field) {
    std::vector<std::uint32_t> colours(sample_count(field.columns(), field.rows()));
    for (std::size_t k = 0; k < colours.size(); ++k) { colours[k] = static_cast<std::uint32_t>(k) * 7U + 3U; }
    return colours;
}

std::vector<SampleTriangle> sample_triangles(
    const GroundMesh& mesh, const models::heights::HeightField& field, const glm::dvec3& eye_m) {
    const glm::dvec2 half_m = field.half_extent_m();
    std::vector<std::uint32_t> sample_of;
    bool all_found = true;
    for (const models::ColourVertex& vertex : mesh.vertices) {
        const double x = static_cast<double>(vertex.position_m.x) + eye_m.x + half_m.x;
        const double y = static_cast<double>(vertex.position_m.y) + eye_m.y + half_m.y;
        const int column = static_cast<int>(std::lround(x / field.spacing_m()));
        const int row = static_cast<int>(std::lround(y / field.spacing_m()));
        if (column < 0 || row < 0 || column >= field.columns() || row >= field.rows()) {
            all_found = false;
            break;
        }
        const glm::dvec3 off = glm::dvec3(vertex.position_m) + eye_m - field.sample_m(column, row);
        all_found = all_found && glm::dot(off, off) < 1e-6;
        sample_of.push_back(static_cast<std::uint32_t>(row * field.columns() + column));
    }
    REQUIRE(all_found);
    std::vector<SampleTriangle> triangles;
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        triangles.push_back(
            smallest_first(sample_of[mesh.indices[k]], sample_of[mesh.indices[k + 1]], sample_of[mesh.indices[k + 2]]));
    }
    return triangles;
}

GroundCheck checked_ground(const std::vector<SampleTriangle>& triangles, const models::heights::HeightField& field) {
    GroundCheck check;
    std::vector<std::uint64_t> edges; // smaller sample, larger sample, direction
    edges.reserve(3 * triangles.size());
    const auto add_edge = [&](std::uint64_t a, std::uint64_t b) {
        edges.push_back(a < b ? a << 32U | b << 1U : b << 32U | a << 1U | 1U);
    };
    for (const SampleTriangle& t : triangles) {
        const long twice = twice_plan_area(t, field);
        check.counter_clockwise = check.counter_clockwise && twice > 0;
        check.signed_area2 += twice;
        add_edge(t.a, t.b);
        add_edge(t.b, t.c);
        add_edge(t.c, t.a);
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t k = 0; k < edges.size();) {
        std::size_t next = k + 1;
        while (next < edges.size() && edges[next] >> 1U == edges[k] >> 1U) { ++next; }
        const bool once_each_way = next == k + 2 && edges[k] != edges[k + 1];
        const auto a = static_cast<std::uint32_t>(edges[k] >> 32U);
        const auto b = static_cast<std::uint32_t>(edges[k] >> 1U & 0x7fffffffU);
        if (!once_each_way && !(next == k + 1 && on_border(a, b, field))) { ++check.unmatched_edges; }
        k = next;
    }
    return check;
}

bool ground_triangles_conform(const std::vector<SampleTriangle>& triangles, const models::heights::HeightField& field) {
    const GroundCheck check = checked_ground(triangles, field);
    return check.counter_clockwise && check.unmatched_edges == 0 &&
           check.signed_area2 == 2L * (field.columns() - 1) * (field.rows() - 1);
}

QuadtreeOptions random_options(Numbers& numbers) {
    return {numbers.coin() ? Roughness::Printed : Roughness::Midpoint,
        numbers.next() % 4 == 0 ? RoughnessPropagation::Printed : RoughnessPropagation::CrackFree,
        numbers.coin() ? 2.0 : 1.6};
}

MeshView random_view(Numbers& numbers, const models::heights::HeightField& field) {
    const glm::dvec2 reach = field.half_extent_m() * 1.3;
    const glm::dvec3 eye_m(numbers.between(-reach.x, reach.x), numbers.between(-reach.y, reach.y),
        numbers.between(-5.0, numbers.coin() ? 10.0 : 80.0));
    MeshView view;
    view.eye_m = eye_m;
    if (numbers.next() % 4 != 0) {
        view = camera_view(eye_m, numbers.between(0.0, 6.28), numbers.between(-1.2, 0.4), numbers.between(0.1, 1.6));
    }
    view.magnification = numbers.coin() ? 1.0 : numbers.between(1.0, 8.0);
    return view;
}

long wrongly_ordered_rays(
    const std::vector<SampleTriangle>& triangles, const models::heights::HeightField& field, const glm::dvec3& eye_m) {
    std::vector<std::array<glm::dvec2, 3>> corners;
    const auto seen_m = [&](std::uint32_t sample) {
        const Place at = place_of(sample, field);
        const glm::dvec3 world_m = field.sample_m(static_cast<int>(at.column), static_cast<int>(at.row));
        return glm::dvec2(world_m - eye_m);
    };
    for (const SampleTriangle& t : triangles) { corners.push_back({seen_m(t.a), seen_m(t.b), seen_m(t.c)}); }
    long wrong = 0;
    constexpr double tolerance_m = 1e-6;
    for (const glm::dvec2& direction : directions_between(corners)) {
        double nearest_m = std::numeric_limits<double>::infinity();
        for (const auto& triangle : corners) {
            const auto passage = passage_through(triangle, direction);
            if (passage && passage->last > nearest_m + tolerance_m) {
                ++wrong;
                break;
            }
            nearest_m = passage ? passage->first : nearest_m;
        }
    }
    return wrong;
}

MeshView camera_view(const glm::dvec3& eye_m, double yaw_rad, double pitch_rad, double fov_rad) {
    const glm::dvec3 ahead(
        std::cos(yaw_rad) * std::cos(pitch_rad), std::sin(yaw_rad) * std::cos(pitch_rad), std::sin(pitch_rad));
    const glm::dvec3 right(std::sin(yaw_rad), -std::cos(yaw_rad), 0.0);
    const glm::dvec3 up = glm::cross(right, ahead);
    const double tall = std::tan(0.5 * fov_rad);
    const double wide = tall * 1.5;
    MeshView view;
    view.eye_m = eye_m;
    view.frustum_normals = {glm::normalize(ahead * wide + right), glm::normalize(ahead * wide - right),
        glm::normalize(ahead * tall + up), glm::normalize(ahead * tall - up)};
    return view;
}

} // namespace octant::visuals::terrain::test
