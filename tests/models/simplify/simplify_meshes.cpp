#include "tests/models/simplify/simplify_meshes.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace octant::tests {

namespace {

using models::Triangle;
using models::TriangleMesh;

/// Shares vertices of the same place.
class Welder {
public:
    std::uint32_t vertex(const glm::dvec3& place_m) {
        const auto key = [](double value) { return std::lround(value * 1e6); };
        const auto [at, added] = numbers_.try_emplace(
            {key(place_m.x), key(place_m.y), key(place_m.z)}, static_cast<std::uint32_t>(mesh.vertices_m.size()));
        if (added) { mesh.vertices_m.push_back(place_m); }
        return at->second;
    }

    void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
        const std::array<std::uint32_t, 4> v = {vertex(a), vertex(b), vertex(c), vertex(d)};
        triangle(v[0], v[1], v[2]);
        triangle(v[0], v[2], v[3]);
    }

    /// n x m fields between four corners.
    void patch(const std::array<glm::dvec3, 4>& corners, int n, int m) {
        const auto at = [&](int i, int j) {
            const double u = static_cast<double>(i) / n;
            const double v = static_cast<double>(j) / m;
            return (1 - u) * (1 - v) * corners[0] + u * (1 - v) * corners[1] + u * v * corners[2] +
                   (1 - u) * v * corners[3];
        };
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < m; ++j) { quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)); }
        }
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a != b && b != c && c != a) { mesh.triangles.push_back({a, b, c}); }
    }

    TriangleMesh mesh;

private:
    std::map<std::tuple<long, long, long>, std::uint32_t> numbers_;
};

std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) { ++edges[{t[i], t[(i + 1) % 3]}]; }
    }
    return edges;
}

} // namespace

TriangleMesh tetrahedron() {
    TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return mesh;
}

TriangleMesh octahedron() {
    TriangleMesh mesh;
    mesh.vertices_m = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return mesh;
}

TriangleMesh cube(int n) {
    Welder w;
    const auto p = [](int x, int y, int z) { return glm::dvec3(x, y, z); };
    w.patch({p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0)}, n, n);
    w.patch({p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)}, n, n);
    w.patch({p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)}, n, n);
    w.patch({p(0, 1, 0), p(0, 1, 1), p(1, 1, 1), p(1, 1, 0)}, n, n);
    w.patch({p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0)}, n, n);
    w.patch({p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)}, n, n);
    return std::move(w.mesh);
}

TriangleMesh ring(int n, int m) {
    Welder w;
    const auto at = [&](int i, int j) {
        const double a = 2.0 * std::numbers::pi * (i % n) / n;
        const double b = 2.0 * std::numbers::pi * (j % m) / m;
        const double radius = 1.0 + 0.4 * std::cos(b);
        return glm::dvec3(radius * std::cos(a), radius * std::sin(a), 0.4 * std::sin(b));
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) { w.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)); }
    }
    return std::move(w.mesh);
}

TriangleMesh ball(int n) {
    Welder w;
    const auto at = [&](int i, int j) {
        const double a = 2.0 * std::numbers::pi * (i % n) / n;
        const double b = std::numbers::pi * j / n;
        return glm::dvec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b));
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) { w.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)); }
    }
    return std::move(w.mesh);
}

TriangleMesh strip(int n, int m) {
    Welder w;
    const double length = static_cast<double>(m) / n;
    w.patch({glm::dvec3(0, 0, 0), {length, 0, 0}, {length, 1, 0}, {0, 1, 0}}, m, n);
    return std::move(w.mesh);
}

TriangleMesh machined_part(int n) {
    // A profile in x and z, drawn out along y: a block with a step and a quarter round.
    std::vector<glm::dvec3> profile = {{0, 0, 0}, {2, 0, 0}, {2, 0, 0.5}};
    for (int i = 0; i <= n; ++i) {
        const double a = 0.5 * std::numbers::pi * i / n;
        profile.emplace_back(1.2 - 0.7 * std::sin(a), 0.0, 1.2 - 0.7 * std::cos(a));
    }
    profile.emplace_back(0.0, 0.0, 1.2);
    Welder w;
    const glm::dvec3 deep(0.0, 1.0, 0.0);
    const glm::dvec3 middle(0.3, 0.0, 0.3);
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const glm::dvec3& a = profile[i];
        const glm::dvec3& b = profile[(i + 1) % profile.size()];
        const int cuts = std::max(1, static_cast<int>(glm::distance(a, b) * n / 2));
        w.patch({a, a + deep, b + deep, b}, n, cuts);
        w.patch({middle, a, b, middle}, n, cuts);
        w.patch({middle + deep, b + deep, a + deep, middle + deep}, n, cuts);
    }
    for (Triangle& t : w.mesh.triangles) { std::swap(t[1], t[2]); }
    return std::move(w.mesh);
}

TriangleMesh hills_with_boxes(int boxes, double edge_m) {
    TriangleMesh mesh = strip(100, 100);
    for (glm::dvec3& vertex_m : mesh.vertices_m) {
        vertex_m.z = 0.02 * std::sin(12.0 * vertex_m.x) * std::cos(9.0 * vertex_m.y);
    }
    const TriangleMesh box = cube(1);
    for (int i = 0; i < boxes; ++i) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
        const glm::dvec3 corner_m(0.05 + 0.17 * (i % 6), 0.05 + 0.17 * (i / 6), 0.3);
        for (const glm::dvec3& vertex : box.vertices_m) { mesh.vertices_m.push_back(corner_m + edge_m * vertex); }
        for (const auto& [a, b, c] : box.triangles) { mesh.triangles.push_back({a + first, b + first, c + first}); }
    }
    return mesh;
}

bool is_manifold(const TriangleMesh& mesh) {
    for (const auto& [edge, count] : directed_edges(mesh)) {
        if (count > 1 || edge.first == edge.second) { return false; }
    }
    std::set<Triangle> sets;
    return std::ranges::all_of(mesh.triangles, [&](Triangle t) {
        std::ranges::sort(t);
        return sets.insert(t).second;
    });
}

std::size_t boundary_edges(const TriangleMesh& mesh) {
    const auto edges = directed_edges(mesh);
    return static_cast<std::size_t>(std::ranges::count_if(edges, [&](const auto& entry) {
        return !edges.contains({entry.first.second, entry.first.first});
    }));
}

long euler_number(const TriangleMesh& mesh) {
    std::set<std::uint32_t> vertices;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& [edge, count] : directed_edges(mesh)) {
        vertices.insert(edge.first);
        edges.insert(std::minmax(edge.first, edge.second));
    }
    return static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) +
           static_cast<long>(mesh.triangles.size());
}

double area_m2(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const auto& v = mesh.vertices_m;
        sum += 0.5 * glm::length(glm::cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]));
    }
    return sum;
}

double volume_m3(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const auto& v = mesh.vertices_m;
        sum += glm::dot(v[t[0]], glm::cross(v[t[1]], v[t[2]])) / 6.0;
    }
    return sum;
}

bool same_bytes(const TriangleMesh& a, const TriangleMesh& b) {
    return a.vertices_m == b.vertices_m && a.triangles == b.triangles && a.colours == b.colours &&
           a.normals == b.normals && a.corner_normals == b.corner_normals &&
           a.triangle_materials == b.triangle_materials;
}

} // namespace octant::tests
