// Finds defects by sorting. All sides of all triangles are sorted by their vertices, so that the
// sides of one edge are neighbours in the list. Two union-find structures follow: one joins corners
// at the same vertex across edges (a vertex with more than one set of corners is not a manifold),
// the other joins triangles (each set is a shell). The genus of a closed oriented manifold follows
// from Euler's formula V - E + F = 2 (shells - genus).
#include "models/measure/mesh_defects.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace octant::models::measure {

namespace {

/// Disjoint sets with union and find (path halving).
class JoinedSets {
public:
    explicit JoinedSets(std::size_t count)
        : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    }

    std::size_t root(std::size_t member) {
        while (parents_[member] != member) {
            parents_[member] = parents_[parents_[member]];
            member = parents_[member];
        }
        return member;
    }

    void join(std::size_t one, std::size_t other) { parents_[root(one)] = root(other); }

private:
    std::vector<std::size_t> parents_;
};

/// One side of one triangle, its two vertices in ascending order.
struct Side {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    bool upward = false;         ///< The triangle runs from `low` to `high`.
    std::size_t low_corner = 0;  ///< Its corner at `low`, numbered 3 * triangle + corner.
    std::size_t high_corner = 0; ///< Its corner at `high`.

    bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

bool repeats_vertex(const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    return a == b || b == c || c == a;
}

bool is_flat(const TriangleMesh& mesh, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 ab = mesh.vertices_m[b] - mesh.vertices_m[a];
    const glm::dvec3 ac = mesh.vertices_m[c] - mesh.vertices_m[a];
    const glm::dvec3 bc = ac - ab;
    const double longest2 = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
    return !(glm::length(glm::cross(ab, ac)) > 1e-14 * longest2);
}

/// The sides of all triangles without repeated vertices, those of the same edge next to each other.
std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
    std::vector<Side> sides;
    sides.reserve(mesh.triangles.size() * 3);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& triangle = mesh.triangles[i];
        if (repeats_vertex(triangle)) {
            continue;
        }
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::size_t next = (corner + 1) % 3;
            const bool upward = triangle[corner] < triangle[next];
            const std::size_t low = upward ? corner : next;
            const std::size_t high = upward ? next : corner;
            sides.push_back({triangle[low], triangle[high], upward, 3 * i + low, 3 * i + high});
        }
    }
    std::ranges::sort(sides, [](const Side& one, const Side& other) {
        return std::array<std::size_t, 3>{one.low, one.high, one.low_corner} <
               std::array<std::size_t, 3>{other.low, other.high, other.low_corner};
    });
    return sides;
}

std::size_t count_duplicates(const TriangleMesh& mesh) {
    std::vector<Triangle> faces;
    faces.reserve(mesh.triangles.size());
    for (Triangle triangle : mesh.triangles) {
        if (!repeats_vertex(triangle)) {
            std::ranges::sort(triangle);
            faces.push_back(triangle);
        }
    }
    std::ranges::sort(faces);
    return static_cast<std::size_t>(faces.end() - std::unique(faces.begin(), faces.end()));
}

/// Counts defects along edges, and joins corners to fans and triangles to shells on the way.
class Joints {
public:
    explicit Joints(const TriangleMesh& mesh)
        : mesh_(mesh)
        , fans_(mesh.triangles.size() * 3)
        , shells_(mesh.triangles.size()) {}

    /// Takes all sides of one edge.
    void take_edge(std::span<const Side> sides, MeshDefects& found) {
        ++edges_;
        for (const Side& side : sides.subspan(1)) {
            fans_.join(sides[0].low_corner, side.low_corner);
            fans_.join(sides[0].high_corner, side.high_corner);
            shells_.join(sides[0].low_corner / 3, side.low_corner / 3);
        }
        if (sides.size() == 1) {
            boundary_.push_back(sides[0]);
        }
        found.boundary_edges += sides.size() == 1 ? 1U : 0U;
        found.non_manifold_edges += sides.size() > 2 ? 1U : 0U;
        found.turned_edges += sides.size() == 2 && sides[0].upward == sides[1].upward ? 1U : 0U;
    }

    /// Counts what is known once all edges have been taken.
    void finish(MeshDefects& found) {
        std::vector<std::size_t> fans(mesh_.vertices_m.size(), 0);
        long faces = 0;
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
            if (repeats_vertex(mesh_.triangles[i])) {
                continue;
            }
            ++faces;
            found.shells += shells_.root(i) == i ? 1U : 0U;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const bool first = fans_.root(3 * i + corner) == 3 * i + corner;
                fans[mesh_.triangles[i][corner]] += first ? 1U : 0U;
            }
        }
        found.non_manifold_vertices = static_cast<std::size_t>(
            std::ranges::count_if(fans, [](std::size_t count) { return count > 1; }));
        const auto used = std::ranges::count_if(fans, [](std::size_t count) { return count > 0; });
        found.euler_characteristic = static_cast<long>(used) - edges_ + faces;
        found.boundary_loops = loops();
    }

private:
    /// The number of boundary loops. Two boundary edges belong to the same loop where they end in
    /// the same fan of corners.
    std::size_t loops() {
        JoinedSets rims(mesh_.triangles.size() * 3);
        std::vector<std::size_t> ends;
        for (const Side& side : boundary_) {
            ends.push_back(fans_.root(side.low_corner));
            rims.join(ends.back(), fans_.root(side.high_corner));
        }
        for (std::size_t& end : ends) {
            end = rims.root(end);
        }
        std::ranges::sort(ends);
        return static_cast<std::size_t>(std::unique(ends.begin(), ends.end()) - ends.begin());
    }

    const TriangleMesh& mesh_;
    JoinedSets fans_;
    JoinedSets shells_;
    std::vector<Side> boundary_;
    long edges_ = 0;
};

std::size_t count_unreferenced(const TriangleMesh& mesh) {
    std::vector<char> used(mesh.vertices_m.size(), 0);
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            used[vertex] = 1;
        }
    }
    return static_cast<std::size_t>(std::ranges::count(used, 0));
}

} // namespace

MeshDefects defects(const TriangleMesh& mesh) {
    MeshDefects found;
    const std::vector<Side> sides = sorted_sides(mesh);
    Joints joints(mesh);
    for (std::size_t first = 0; first < sides.size();) {
        std::size_t last = first + 1;
        while (last < sides.size() && sides[last].same_edge(sides[first])) {
            ++last;
        }
        joints.take_edge(std::span(sides).subspan(first, last - first), found);
        first = last;
    }
    joints.finish(found);
    found.duplicate_faces = count_duplicates(mesh);
    found.degenerate_faces = static_cast<std::size_t>(
        std::ranges::count_if(mesh.triangles, [&](const Triangle& triangle) {
            return repeats_vertex(triangle) || is_flat(mesh, triangle);
        }));
    found.unreferenced_vertices = count_unreferenced(mesh);
    if (found.shells > 0 && found.boundary_edges + found.non_manifold_edges +
                                    found.non_manifold_vertices + found.turned_edges ==
                                0) {
        found.genus = static_cast<long>(found.shells) - found.euler_characteristic / 2;
    }
    return found;
}

} // namespace octant::models::measure
