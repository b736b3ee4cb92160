#include "tests/visuals/refine/made_sequence.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace octant::visuals::refine::test {

namespace {

using models::CollapseSequence;
using models::none;
using models::Triangle;
using models::TriangleMesh;

/// Vertices numbered as a CollapseSequence numbers them, those in use with their triangles.
class Collapsing {
public:
    explicit Collapsing(TriangleMesh mesh)
        : triangles_(mesh.triangles), positions_m_(mesh.vertices_m), errors_m_(mesh.vertices_m.size(), 0.0),
          at_(mesh.vertices_m.size()) {
        sequence_.original = std::move(mesh);
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                at_[triangles_[t][k]].insert(t);
                add_edge(triangles_[t][k], triangles_[t][(k + 1) % 3]);
            }
        }
    }

    CollapseSequence run(std::size_t most) {
        while (!edges_.empty() && sequence_.collapses.size() < most) {
            const auto [length_m, first, second] = *edges_.begin();
            edges_.erase(edges_.begin());
            if (!at_[first].empty() && !at_[second].empty() && allowed(first, second)) { collapse(first, second); }
        }
        return std::move(sequence_);
    }

private:
    using Edge = std::tuple<double, std::uint32_t, std::uint32_t>;

    void add_edge(std::uint32_t a, std::uint32_t b) {
        edges_.insert({glm::distance(positions_m_[a], positions_m_[b]), std::min(a, b), std::max(a, b)});
    }

    /// Each with the number of triangles that it shares with the vertex.
    std::map<std::uint32_t, int> neighbours(std::uint32_t vertex) const {
        std::map<std::uint32_t, int> around;
        for (const std::uint32_t t : at_[vertex]) {
            for (const std::uint32_t corner : triangles_[t]) {
                if (corner != vertex) { ++around[corner]; }
            }
        }
        return around;
    }

    bool allowed(std::uint32_t first, std::uint32_t second) const {
        const auto of_first = neighbours(first);
        const auto of_second = neighbours(second);
        int common = 0;
        for (const auto& [vertex, shared] : of_first) { common += of_second.count(vertex) != 0 ? 1 : 0; }
        const int between = of_first.at(second);
        const auto open = [](const std::map<std::uint32_t, int>& around) {
            return std::ranges::any_of(around, [](const auto& each) { return each.second == 1; });
        };
        const bool alone = between == 2 ? of_first.size() == 3 && of_second.size() == 3
                                        : of_first.size() == 2 && of_second.size() == 2;
        return common == between && !alone && !(between == 2 && open(of_first) && open(of_second));
    }

    void collapse(std::uint32_t first, std::uint32_t second) {
        models::Collapse collapse{.first = first, .second = second};
        collapse.position_m = 0.5 * (positions_m_[first] + positions_m_[second]);
        collapse.error_m = std::max(errors_m_[first], errors_m_[second]) +
                           0.5 * glm::distance(positions_m_[first], positions_m_[second]);
        if (!sequence_.original.colours.empty()) { collapse.colour = glm::vec3(0.5F); }
        const auto made = static_cast<std::uint32_t>(positions_m_.size());
        positions_m_.push_back(collapse.position_m);
        errors_m_.push_back(collapse.error_m);
        at_.emplace_back();
        for (const std::uint32_t t : std::set<std::uint32_t>(at_[first])) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (triangles_[t][k] == first && triangles_[t][(k + 1) % 3] == second) {
                    collapse.left = t;
                } else if (triangles_[t][k] == second && triangles_[t][(k + 1) % 3] == first) {
                    collapse.right = t;
                }
            }
        }
        for (const std::uint32_t t : {collapse.left, collapse.right}) {
            if (t != none) {
                for (const std::uint32_t corner : triangles_[t]) { at_[corner].erase(t); }
            }
        }
        for (const std::uint32_t child : {first, second}) {
            for (const std::uint32_t t : at_[child]) {
                std::ranges::replace(triangles_[t], child, made);
                at_[made].insert(t);
            }
            at_[child].clear();
        }
        sequence_.collapses.push_back(collapse);
        for (const auto& [vertex, shared] : neighbours(made)) {
            add_edge(made, vertex);
            // Edges that were not allowed may be now.
            for (const auto& [other, shared_too] : neighbours(vertex)) { add_edge(vertex, other); }
        }
    }

    CollapseSequence sequence_;
    std::vector<Triangle> triangles_;
    std::vector<glm::dvec3> positions_m_;
    std::vector<double> errors_m_;
    std::vector<std::set<std::uint32_t>> at_;
    std::set<Edge> edges_;
};

double random_height_m(std::uint64_t& state) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 40U) / static_cast<double>(1U << 24U);
}

} // namespace

TriangleMesh made_sphere(int cuts) {
    TriangleMesh mesh;
    mesh.name = "sphere";
    mesh.vertices_m = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int cut = 0; cut < cuts; ++cut) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, added] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices_m.size()));
            if (added) { mesh.vertices_m.push_back(glm::normalize(mesh.vertices_m[a] + mesh.vertices_m[b])); }
            return at->second;
        };
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const std::uint32_t ab = middle(a, b);
            const std::uint32_t bc = middle(b, c);
            const std::uint32_t ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.triangles = finer;
    }
    return mesh;
}

TriangleMesh made_torus(std::uint32_t around, std::uint32_t across) {
    TriangleMesh mesh;
    mesh.name = "torus";
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const double a = 2.0 * std::numbers::pi * i / around;
            const double b = 2.0 * std::numbers::pi * j / across;
            const double reach = 1.0 + 0.4 * std::cos(b);
            mesh.vertices_m.emplace_back(reach * std::cos(a), reach * std::sin(a), 0.4 * std::sin(b));
            const auto at = [&](std::uint32_t x, std::uint32_t y) { return x % around * across + y % across; };
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

TriangleMesh made_grid(std::uint32_t size) {
    TriangleMesh mesh;
    mesh.name = "grid";
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            mesh.vertices_m.emplace_back(x, y, 0.0);
            mesh.colours.emplace_back(static_cast<float>(x) / static_cast<float>(size),
                static_cast<float>(y) / static_cast<float>(size), 0.5F);
            if (x + 1 < size && y + 1 < size) {
                const std::uint32_t at = y * size + x;
                mesh.triangles.push_back({at, at + 1, at + size + 1});
                mesh.triangles.push_back({at, at + size + 1, at + size});
            }
        }
    }
    return mesh;
}

TriangleMesh made_ground(std::uint32_t size, std::uint64_t seed) {
    TriangleMesh mesh = made_grid(size);
    mesh.name = "ground";
    mesh.materials = {{"even", glm::vec3(0.2F)}, {"odd", glm::vec3(0.8F)}};
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m.z = random_height_m(seed); }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) { mesh.triangle_materials.push_back(t % 2); }
    return mesh;
}

CollapseSequence collapsed(TriangleMesh mesh) {
    return collapsed(std::move(mesh), std::numeric_limits<std::size_t>::max());
}

CollapseSequence collapsed(TriangleMesh mesh, std::size_t max_collapses) {
    return Collapsing(std::move(mesh)).run(max_collapses);
}

} // namespace octant::visuals::refine::test
