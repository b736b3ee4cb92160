#include "tests/visuals/terrain/error_ground.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace octant::visuals::terrain::test {

namespace {

/// (b - a) x (c - a) in plan.
double signed_area2(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

} // namespace

models::heights::HeightField ErrorGround::stored_field(const GroundTiles& tiles) {
    std::vector<float> heights_m;
    for (int row = 0; row < tiles.rows(); ++row) {
        for (int column = 0; column < tiles.columns(); ++column) { heights_m.push_back(tiles.height_m(column, row)); }
    }
    return {tiles.columns(), tiles.rows(), tiles.spacing_m(), std::move(heights_m)};
}

models::heights::HeightField any_field(int columns, int rows, Numbers& numbers) {
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
        const double whole = signed_area2(a, b, c);
        const auto least = [](double p, double q, double r) { return static_cast<int>(std::min({p, q, r})); };
        const auto most = [](double p, double q, double r) { return static_cast<int>(std::max({p, q, r})); };
        for (int row = least(a.y, b.y, c.y); row <= most(a.y, b.y, c.y); ++row) {
            for (int column = least(a.x, b.x, c.x); column <= most(a.x, b.x, c.x); ++column) {
                const glm::dvec3 at(column, row, 0.0);
                const double of_a = signed_area2(at, b, c);
                const double of_b = signed_area2(at, c, a);
                const double of_c = signed_area2(at, a, b);
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
