#include "tests/visuals/terrain/ground_check.h"

#include "sim/base/plane.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

namespace octant::visuals::terrain::test {

namespace {

template <typename Item>
bool same_bytes(const std::vector<Item>& a, const std::vector<Item>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Item)) == 0);
}

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

double heading_of(const glm::dvec2& place) { return std::atan2(place.y, place.x); }

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

/// Headings between each two neighbouring ones of those to the corners, ascending. The last one may be above pi.
std::vector<double> headings_between(const std::vector<std::array<glm::dvec2, 3>>& triangles) {
    std::vector<double> angles_rad;
    for (const auto& corners : triangles) {
        for (const glm::dvec2& corner : corners) { angles_rad.push_back(heading_of(corner)); }
    }
    std::sort(angles_rad.begin(), angles_rad.end());
    if (!angles_rad.empty()) { angles_rad.push_back(angles_rad.front() + 2.0 * std::numbers::pi); }
    std::vector<double> headings_rad;
    constexpr double min_gap_rad = 1e-7;
    for (std::size_t k = 1; k < angles_rad.size(); ++k) {
        if (angles_rad[k] - angles_rad[k - 1] > min_gap_rad) {
            headings_rad.push_back(0.5 * (angles_rad[k] + angles_rad[k - 1]));
        }
    }
    return headings_rad;
}

/// Those of ascending headings at which a ray from the origin may pass a triangle: from the first to before the last
/// number. All where the triangle is around the origin or across the heading pi.
std::pair<std::size_t, std::size_t> headings_across(
    const std::array<glm::dvec2, 3>& triangle, const std::vector<double>& headings_rad) {
    const auto [low, high] = std::minmax({heading_of(triangle[0]), heading_of(triangle[1]), heading_of(triangle[2])});
    if (high - low >= std::numbers::pi - 1e-6) { return {0, headings_rad.size()}; }
    return {static_cast<std::size_t>(std::ranges::lower_bound(headings_rad, low) - headings_rad.begin()),
        static_cast<std::size_t>(std::ranges::upper_bound(headings_rad, high) - headings_rad.begin())};
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

MeshView everywhere_from(const MeshView& view) {
    MeshView everywhere = view;
    everywhere.frustum_normals.fill(glm::dvec3(0.0));
    return everywhere;
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
    constexpr double tolerance_m = 1e-6;
    const std::vector<double> headings_rad = headings_between(corners);
    std::vector<double> nearest_m(headings_rad.size(), std::numeric_limits<double>::infinity());
    std::vector<bool> is_wrong(headings_rad.size(), false);
    for (const auto& triangle : corners) {
        const auto [first, last] = headings_across(triangle, headings_rad);
        for (std::size_t ray = first; ray < last; ++ray) {
            const glm::dvec2 direction(std::cos(headings_rad[ray]), std::sin(headings_rad[ray]));
            const auto passage = passage_through(triangle, direction);
            if (!passage) { continue; }
            is_wrong[ray] = is_wrong[ray] || passage->last > nearest_m[ray] + tolerance_m;
            nearest_m[ray] = passage->first;
        }
    }
    return std::count(is_wrong.begin(), is_wrong.end(), true);
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

MeshView circling(int frame) {
    const double angle = frame * 0.02;
    return camera_view({70.0 * std::cos(angle), 70.0 * std::sin(angle), 15.0}, angle + 1.57, -0.2, 0.9);
}

MeshView into_the_sky() { return camera_view({0.0, 0.0, 200.0}, 0.3, 1.2, 0.9); }

Corners corners_of(const GroundMesh& mesh, std::size_t triangle) {
    Corners corners{};
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = glm::dvec3(mesh.vertices[mesh.indices[3 * triangle + k]].position_m);
    }
    return corners;
}

bool reaches_into(const Corners& corners, const MeshView& view) {
    constexpr int parts = 5;
    for (int i = 0; i <= parts; ++i) {
        for (int j = 0; i + j <= parts; ++j) {
            const glm::dvec3 point = corners[0] + (corners[1] - corners[0]) * (1.0 * i / parts) +
                                     (corners[2] - corners[0]) * (1.0 * j / parts);
            if (std::all_of(view.frustum_normals.begin(), view.frustum_normals.end(),
                    [&](const glm::dvec3& normal) { return glm::dot(normal, point) >= 0.0; })) {
                return true;
            }
        }
    }
    return false;
}

bool SearchBox::meets(const glm::dvec3& min_m, const glm::dvec3& max_m) const {
    const glm::dvec3 above = max_m - (middle_m - half_m);
    const glm::dvec3 below = middle_m + half_m - min_m;
    return std::min({above.x, above.y, above.z, below.x, below.y, below.z}) >= 0.0;
}

long checked_count_in(
    const SearchBox& box, const GroundMesh& mesh, const glm::dvec3& eye_m, std::span<const std::uint32_t> found) {
    constexpr double rounding_m = 1e-4; // positions are floats
    REQUIRE(std::adjacent_find(found.begin(), found.end(), std::greater_equal<>()) == found.end());
    REQUIRE((found.empty() || 3 * found.back() < mesh.indices.size()));
    long count = 0;
    for (std::uint32_t triangle = 0; 3 * triangle < mesh.indices.size(); ++triangle) {
        const auto [a, b, c] = corners_of(mesh, triangle);
        const glm::dvec3 min_m = glm::min(a, glm::min(b, c)) + eye_m + rounding_m;
        const glm::dvec3 max_m = glm::max(a, glm::max(b, c)) + eye_m - rounding_m;
        if (box.meets(min_m, max_m)) {
            ++count;
            REQUIRE(std::binary_search(found.begin(), found.end(), triangle));
        }
    }
    return count;
}

MeshCopy::MeshCopy(const GroundMesh& mesh)
    : vertices(mesh.vertices.begin(), mesh.vertices.end()), morphs(mesh.morphs.begin(), mesh.morphs.end()),
      indices(mesh.indices.begin(), mesh.indices.end()), triangles(mesh.counters.triangles), fans(mesh.counters.fans),
      resolution(mesh.resolution), error_px(mesh.error_px) {}

bool MeshCopy::operator==(const MeshCopy& other) const {
    return same_bytes(vertices, other.vertices) && same_bytes(morphs, other.morphs) && indices == other.indices &&
           triangles == other.triangles && fans == other.fans && resolution == other.resolution &&
           error_px == other.error_px;
}

models::heights::HeightField ErrorGround::stored_field(const GroundTiles& tiles) {
    std::vector<float> heights_m;
    for (int row = 0; row < tiles.rows(); ++row) {
        for (int column = 0; column < tiles.columns(); ++column) { heights_m.push_back(tiles.height_m(column, row)); }
    }
    return {tiles.columns(), tiles.rows(), tiles.spacing_m(), std::move(heights_m)};
}

models::heights::HeightField any_field(const FieldSize& size, Numbers& numbers) {
    const auto [columns, rows] = size;
    switch (numbers.next() % 6) {
    case 0:
        return level_field(columns, rows);
    case 1:
    case 2:
        return spiky_field(columns, rows, numbers.next());
    default:
        return rough_field(columns, rows, numbers.next());
    }
}

MeshView any_view(Numbers& numbers, const models::heights::HeightField& field) {
    MeshView view = random_view(numbers, field);
    view.focal_px = numbers.between(200.0, 2000.0);
    view.earth_radius_m = numbers.coin() ? 0.0 : numbers.between(300.0, 3000.0);
    return view;
}

double any_error_px(Numbers& numbers) { return std::exp(numbers.between(std::log(0.5), std::log(300.0))); }

std::vector<SampleTriangle> origin_triangles(
    const GroundMesh& mesh, const models::heights::HeightField& field, const glm::dvec3& eye_m) {
    REQUIRE(mesh.morphs.size() == mesh.vertices.size());
    std::vector<std::uint8_t> used(mesh.vertices.size(), 0);
    for (const std::uint32_t vertex : mesh.indices) { used[vertex] = 1; }
    std::vector<std::uint32_t> samples;
    std::vector<std::uint32_t> used_samples;
    bool in_place = true;
    for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
        const VertexMorph& origin = mesh.morphs[k];
        const glm::dvec3 sample_m = field.sample_m(origin.column, origin.row) - eye_m;
        const glm::vec3& drawn_m = mesh.vertices[k].position_m;
        samples.push_back(static_cast<std::uint32_t>(origin.row * field.columns() + origin.column));
        if (used[k] != 0) {
            in_place = in_place && std::abs(static_cast<double>(drawn_m.x) - sample_m.x) < 1e-3 &&
                       std::abs(static_cast<double>(drawn_m.y) - sample_m.y) < 1e-3;
            used_samples.push_back(samples.back());
        }
    }
    REQUIRE(in_place);
    std::vector<SampleTriangle> triangles;
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        triangles.push_back(
            smallest_first(samples[mesh.indices[k]], samples[mesh.indices[k + 1]], samples[mesh.indices[k + 2]]));
    }
    std::sort(used_samples.begin(), used_samples.end());
    REQUIRE(std::adjacent_find(used_samples.begin(), used_samples.end()) == used_samples.end());
    return triangles;
}

std::vector<double> drawn_heights_m(
    const GroundMesh& mesh, const models::heights::HeightField& field, const glm::dvec3& eye_m) {
    std::vector<double> heights_m(static_cast<std::size_t>(field.columns()) * static_cast<std::size_t>(field.rows()),
        std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t j = 0; j < 3; ++j) {
            const std::uint32_t vertex = mesh.indices[k + j];
            const VertexMorph& origin = mesh.morphs[vertex];
            corners[j] = {origin.column, origin.row, static_cast<double>(mesh.vertices[vertex].position_m.z) + eye_m.z};
        }
        const auto [a, b, c] = corners;
        const auto area2 = [](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
            return signed_area2(glm::dvec2(p), glm::dvec2(q), glm::dvec2(r));
        };
        const double whole = area2(a, b, c);
        const auto min = [](double p, double q, double r) { return static_cast<int>(std::min({p, q, r})); };
        const auto max = [](double p, double q, double r) { return static_cast<int>(std::max({p, q, r})); };
        for (int row = min(a.y, b.y, c.y); row <= max(a.y, b.y, c.y); ++row) {
            for (int column = min(a.x, b.x, c.x); column <= max(a.x, b.x, c.x); ++column) {
                const glm::dvec3 at(column, row, 0.0);
                const double of_a = area2(at, b, c);
                const double of_b = area2(at, c, a);
                const double of_c = area2(at, a, b);
                if (std::min({of_a, of_b, of_c}) >= 0.0) {
                    heights_m[static_cast<std::size_t>(row * field.columns() + column)] =
                        (of_a * a.z + of_b * b.z + of_c * c.z) / whole;
                }
            }
        }
    }
    return heights_m;
}

} // namespace octant::visuals::terrain::test
