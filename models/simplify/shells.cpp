#include "models/simplify/shells.h"

#include "models/measure/triangle_bvh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

namespace octant::models::simplify {

namespace {

/// The shares of the wanted faces that shells may need at least.
constexpr double filled = 0.8;
constexpr std::array filled_by_farness = {0.95, 0.8, 0.65, 0.5};
/// How many searches for a nearest point are worth while to choose shells.
constexpr std::size_t most_searches = 2'000'000;

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t vertex) {
    while (parents[vertex] != vertex) {
        parents[vertex] = parents[parents[vertex]];
        vertex = parents[vertex];
    }
    return vertex;
}

/// The triangles that are left of each shell when nothing more collapses.
std::vector<std::size_t> least_triangles(const Shells& shells, const CollapseSequence& exhausted) {
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
    return least;
}

std::vector<std::uint32_t> largest_first(const Shells& shells) {
    std::vector<std::uint32_t> order(shells.sizes_m.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return shells.sizes_m[a] > shells.sizes_m[b];
    });
    return order;
}

/// Shells taken one after the other as long as the triangles that are left of them fit.
class Filling {
public:
    Filling(const std::vector<std::size_t>& least, double room)
        : least_(&least)
        , room_(static_cast<std::size_t>(room))
        , stays_(least.size(), false) {}

    /// Whether it stays: the first one always does.
    bool take(std::uint32_t shell) {
        stays_[shell] = needed_ == 0 || needed_ + (*least_)[shell] <= room_;
        needed_ += stays_[shell] ? (*least_)[shell] : 0;
        return stays_[shell];
    }

    const std::vector<bool>& stays() const { return stays_; }

private:
    const std::vector<std::size_t>* least_;
    std::size_t room_;
    std::vector<bool> stays_;
    std::size_t needed_ = 0;
};

/// How far shells are, by their vertices, from those that stay.
class Farness {
public:
    Farness(const TriangleMesh& mesh, const Shells& shells)
        : mesh_(&mesh)
        , triangles_(shells.sizes_m.size())
        , vertices_(shells.sizes_m.size())
        , far2_m2_(shells.sizes_m.size(), std::numeric_limits<double>::infinity())
        , is_open_(shells.sizes_m.size(), true)
        , distance2_m2_(mesh.vertices_m.size(), std::numeric_limits<double>::infinity()) {
        std::vector<bool> is_known(mesh.vertices_m.size(), false);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const std::uint32_t shell = shells.of_triangle[t];
            triangles_[shell].push_back(mesh.triangles[t]);
            for (const std::uint32_t vertex : mesh.triangles[t]) {
                if (!is_known[vertex]) {
                    is_known[vertex] = true;
                    vertices_[shell].push_back(vertex);
                }
            }
        }
    }

    /// Of those not settled; none: all are.
    std::uint32_t farthest() const {
        std::uint32_t found = none;
        for (std::uint32_t shell = 0; shell < far2_m2_.size(); ++shell) {
            if (is_open_[shell] && (found == none || far2_m2_[shell] > far2_m2_[found])) {
                found = shell;
            }
        }
        return found;
    }

    /// It is known whether that shell stays: the others may be nearer now.
    void settle(std::uint32_t shell, bool stays) {
        is_open_[shell] = false;
        if (!stays) {
            return;
        }
        const measure::TriangleBvh surface(mesh_->vertices_m, triangles_[shell]);
        for (std::uint32_t other = 0; other < far2_m2_.size(); ++other) {
            if (!is_open_[other]) {
                continue;
            }
            far2_m2_[other] = 0.0;
            for (const std::uint32_t vertex : vertices_[other]) {
                double& distance2 = distance2_m2_[vertex];
                distance2 =
                    std::min(distance2, surface.nearest(mesh_->vertices_m[vertex]).distance2);
                far2_m2_[other] = std::max(far2_m2_[other], distance2);
            }
        }
    }

private:
    const TriangleMesh* mesh_;
    std::vector<std::vector<Triangle>> triangles_;
    std::vector<std::vector<std::uint32_t>> vertices_;
    /// Of each shell's farthest vertex.
    std::vector<double> far2_m2_;
    std::vector<bool> is_open_;
    std::vector<double> distance2_m2_; ///< of each vertex from shells that stay
};

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

std::vector<std::vector<bool>>
shells_that_may_stay(const Shells& shells, const CollapseSequence& exhausted, std::size_t faces) {
    const std::vector<std::size_t> least = least_triangles(shells, exhausted);
    const std::vector<std::uint32_t> by_size = largest_first(shells);
    if (by_size.empty()) {
        return {{}};
    }
    const auto wanted = static_cast<double>(faces);
    Filling largest(least, filled * wanted);
    for (const std::uint32_t shell : by_size) {
        largest.take(shell);
    }
    std::vector<std::vector<bool>> ways{largest.stays()};
    const TriangleMesh& mesh = exhausted.original;
    if (mesh.vertices_m.size() * least.size() > most_searches) {
        return ways;
    }
    for (const double share : filled_by_farness) {
        Farness order(mesh, shells);
        Filling farthest(least, share * wanted);
        for (std::uint32_t shell = by_size.front(); shell != none; shell = order.farthest()) {
            order.settle(shell, farthest.take(shell));
        }
        if (!std::ranges::count(ways, farthest.stays())) {
            ways.push_back(farthest.stays());
        }
    }
    return ways;
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
