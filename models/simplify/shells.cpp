#include "models/simplify/shells.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace octant::models::simplify {

namespace {

/// The share of the wanted faces that shells may need at least.
constexpr double filled = 0.8;

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t vertex) {
    while (parents[vertex] != vertex) {
        parents[vertex] = parents[parents[vertex]];
        vertex = parents[vertex];
    }
    return vertex;
}

} // namespace

Shells shells_of(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> parents(mesh.vertices_m.size());
    std::iota(parents.begin(), parents.end(), 0U);
    for (const Triangle& triangle : mesh.triangles) {
        const std::uint32_t first = root_of(parents, triangle[0]);
        parents[root_of(parents, triangle[1])] = first;
        parents[root_of(parents, triangle[2])] = first;
    }
    Shells shells;
    std::vector<std::uint32_t> numbers(mesh.vertices_m.size(), none);
    std::vector<Bounds> bounds;
    for (const Triangle& triangle : mesh.triangles) {
        std::uint32_t& number = numbers[root_of(parents, triangle[0])];
        if (number == none) {
            constexpr double far_m = std::numeric_limits<double>::max();
            number = static_cast<std::uint32_t>(bounds.size());
            bounds.push_back({glm::dvec3(far_m), glm::dvec3(-far_m)});
        }
        shells.of_triangle.push_back(number);
        for (const std::uint32_t vertex : triangle) {
            Bounds& box = bounds[number];
            box.least_m = glm::min(box.least_m, mesh.vertices_m[vertex]);
            box.most_m = glm::max(box.most_m, mesh.vertices_m[vertex]);
        }
    }
    for (const Bounds& box : bounds) {
        shells.sizes_m.push_back(glm::distance(box.least_m, box.most_m));
    }
    return shells;
}

std::vector<bool>
shells_that_stay(const Shells& shells, const CollapseSequence& exhausted, std::size_t faces) {
    std::vector<std::size_t> least(shells.sizes_m.size(), 0);
    for (const std::uint32_t shell : shells.of_triangle) {
        ++least[shell];
    }
    for (const Collapse& collapse : exhausted.collapses) {
        for (const std::uint32_t gone : {collapse.left, collapse.right}) {
            if (gone != none) {
                --least[shells.of_triangle[gone]];
            }
        }
    }
    std::vector<std::uint32_t> largest_first(least.size());
    std::iota(largest_first.begin(), largest_first.end(), 0U);
    std::ranges::stable_sort(largest_first, [&](std::uint32_t a, std::uint32_t b) {
        return shells.sizes_m[a] > shells.sizes_m[b];
    });
    std::vector<bool> stays(least.size(), false);
    std::size_t needed = 0;
    for (const std::uint32_t shell : largest_first) {
        needed += least[shell];
        if (shell != largest_first.front() &&
            static_cast<double>(needed) > filled * static_cast<double>(faces)) {
            break;
        }
        stays[shell] = true;
    }
    return stays;
}

TriangleMesh
only_shells(const TriangleMesh& mesh, const Shells& shells, const std::vector<bool>& stays) {
    TriangleMesh left;
    left.name = mesh.name;
    left.normals = mesh.normals;
    left.materials = mesh.materials;
    left.notes = mesh.notes;
    std::vector<std::uint32_t> numbers(mesh.vertices_m.size(), none);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!stays[shells.of_triangle[t]]) {
            continue;
        }
        Triangle& triangle = left.triangles.emplace_back(mesh.triangles[t]);
        for (std::uint32_t& vertex : triangle) {
            if (numbers[vertex] == none) {
                numbers[vertex] = static_cast<std::uint32_t>(left.vertices_m.size());
                left.vertices_m.push_back(mesh.vertices_m[vertex]);
                if (!mesh.colours.empty()) {
                    left.colours.push_back(mesh.colours[vertex]);
                }
            }
            vertex = numbers[vertex];
        }
        if (!mesh.corner_normals.empty()) {
            left.corner_normals.push_back(mesh.corner_normals[t]);
        }
        if (!mesh.triangle_materials.empty()) {
            left.triangle_materials.push_back(mesh.triangle_materials[t]);
        }
    }
    return left;
}

} // namespace octant::models::simplify
