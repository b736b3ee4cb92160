#pragma once

#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_samples.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace octant::visuals::terrain {

/// What is wrong with a mesh. If all counts are 0, the ground is a single surface without a crack, hole or fold.
struct Conformity {
    /// Edges without a triangle on the other side, although the frustum sees them and the field goes on there.
    int open_edges = 0;
    /// Vertices inside an edge of a triangle that they do not belong to (T-junctions).
    int t_junctions = 0;
    int overlapping_edges = 0; ///< Edges with more than one triangle on a side.
    /// Triangles that are not counter-clockwise from above or have no area.
    int inverted_triangles = 0;
    int duplicate_vertices = 0; ///< Vertices at a position in plan that has another one.

    bool is_conforming() const {
        return open_edges + t_junctions + overlapping_edges + inverted_triangles + duplicate_vertices == 0;
    }

    /// The counts in one line.
    std::string text() const;
};

/// Checks meshes by matching edges. Its memory is reused from mesh to mesh.
class ConformityCheck {
public:
    /// The ground is needed by the constructor only.
    explicit ConformityCheck(const GroundSamples& ground);

    /// Checks a mesh that was made for `view`.
    Conformity check(const GroundMesh& mesh, const MeshView& view);

private:
    /// A slot of a hash table over edges.
    struct Edge {
        std::uint32_t low = 0; ///< The vertex with the smaller number.
        std::uint32_t high = 0;
        std::uint32_t mesh = 0;    ///< Equals mesh_ where the slot is taken.
        std::uint16_t forward = 0; ///< How many triangles run along it from low to high.
        std::uint16_t back = 0;
    };

    void locate_vertices(const GroundMesh& mesh, const MeshView& view);
    void match_edges(const GroundMesh& mesh, Conformity& found);
    void add_edge(std::uint32_t from, std::uint32_t to);
    bool on_border(const glm::dvec2& a, const glm::dvec2& b) const;
    int duplicate_vertices();
    int count_t_junctions();

    double spacing_m_;
    glm::dvec2 half_extent_m_;
    glm::dvec2 last_; ///< The last column and row.
    std::uint32_t mesh_ = 0;
    std::vector<Edge> edges_; ///< The hash table; its size is a power of two.
    std::vector<Edge> open_;
    std::vector<glm::dvec2> places_; ///< For each vertex its position in samples east and north.
    std::vector<std::uint32_t> sorted_;
    std::vector<std::uint8_t> used_;   ///< For each vertex whether a triangle uses it.
    std::vector<std::uint32_t> slots_; ///< A hash table over positions.
};

} // namespace octant::visuals::terrain
