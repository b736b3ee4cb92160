#include "tests/models/measure/made_meshes.h"

#include <cmath>
#include <numbers>

namespace octant::tests {

using models::TriangleMesh;

double Dice::between(double least, double most) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return least + (most - least) * static_cast<double>(state_ >> 11U) / 9007199254740992.0;
}

glm::dvec3 Dice::point(double least, double most) {
    const double x = between(least, most);
    const double y = between(least, most);
    return {x, y, between(least, most)};
}

TriangleMesh plate(int n, double edge_m, double z_m) {
    TriangleMesh mesh;
    mesh.name = "plate";
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) { mesh.vertices_m.emplace_back(edge_m * x / n, edge_m * y / n, z_m); }
    }
    const auto row = static_cast<std::uint32_t>(n + 1);
    for (std::uint32_t y = 0; y + 1 < row; ++y) {
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
            const std::uint32_t corner = y * row + x;
            mesh.triangles.push_back({corner, corner + 1, corner + row + 1});
            mesh.triangles.push_back({corner, corner + row + 1, corner + row});
        }
    }
    return mesh;
}

TriangleMesh ball(int rings, double radius_m) {
    TriangleMesh mesh;
    mesh.name = "ball";
    const auto count = static_cast<std::uint32_t>(rings);
    for (int ring = 0; ring < rings; ++ring) {
        const double polar = std::numbers::pi * (ring + 1) / (rings + 1);
        for (int meridian = 0; meridian < rings; ++meridian) {
            const double around = 2.0 * std::numbers::pi * meridian / rings;
            mesh.vertices_m.push_back(radius_m * glm::dvec3(std::sin(polar) * std::cos(around),
                                                     std::sin(polar) * std::sin(around), std::cos(polar)));
        }
    }
    const std::uint32_t top = count * count;
    mesh.vertices_m.emplace_back(0.0, 0.0, radius_m);
    mesh.vertices_m.emplace_back(0.0, 0.0, -radius_m);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        mesh.triangles.push_back({top, i, next});
        for (std::uint32_t ring = 0; ring + 1 < count; ++ring) {
            const std::uint32_t upper = ring * count;
            const std::uint32_t lower = upper + count;
            mesh.triangles.push_back({upper + i, lower + i, lower + next});
            mesh.triangles.push_back({upper + i, lower + next, upper + next});
        }
        mesh.triangles.push_back({top + 1, top - count + next, top - count + i});
    }
    return mesh;
}

TriangleMesh scattered(std::uint64_t seed, int triangles, double size_m) {
    Dice dice(seed);
    TriangleMesh mesh;
    mesh.name = "scattered";
    for (int i = 0; i < triangles; ++i) {
        const glm::dvec3 middle = dice.point(-1.0, 1.0);
        const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
        for (int corner = 0; corner < 3; ++corner) {
            mesh.vertices_m.push_back(middle + dice.point(-size_m / 2, size_m / 2));
        }
        if (i % 10 == 0) { // a line
            mesh.vertices_m.back() = 0.5 * (mesh.vertices_m[first] + mesh.vertices_m[first + 1]);
        }
        if (i % 20 == 0) { // a point
            mesh.vertices_m[first] = mesh.vertices_m[first + 1] = mesh.vertices_m[first + 2];
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

TriangleMesh shaken(TriangleMesh mesh, std::uint64_t seed, double max_m) {
    Dice dice(seed);
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m += dice.point(-max_m, max_m); }
    return mesh;
}

} // namespace octant::tests
