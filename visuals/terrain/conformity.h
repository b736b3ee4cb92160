#pragma once

#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_samples.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace octant::visuals::terrain {

/// What is wrong with a mesh; all 0 = the ground is one surface without crack, hole or fold.
struct Conformity {
    int open_edges = 0;       ///< without a triangle beyond, though the frustum sees them and the
                              ///< field goes on there
    int corners_on_edges = 0; ///< vertices inside an edge of a triangle they do not belong to
    int crowded_edges = 0;    ///< with more than one triangle on a side
    int turned_triangles = 0; ///< not counter-clockwise from above, or without area
    int doubled_vertices = 0; ///< at a place in plan that has a vertex already

    bool is_whole() const {
        return open_edges + corners_on_edges + crowded_edges + turned_triangles +
                   doubled_vertices ==
               0;
    }

    /// The counts in one line.
    std::string text() const;
};

/// Edge matching. Keeps its memory from one mesh to the next.
class ConformityCheck {
public:
    /// The ground is looked at only now.
    explicit ConformityCheck(const GroundSamples& ground);

    /// `mesh` was made for `view`.
    Conformity check(const GroundMesh& mesh, const MeshView& view);

private:
    /// Slot of a hash table over edges.
    struct Edge {
        std::uint32_t low = 0; ///< smaller vertex
        std::uint32_t high = 0;
        std::uint32_t mesh = 0;    ///< mesh_ where the slot is taken
        std::uint16_t forward = 0; ///< triangles that walk from low to high
        std::uint16_t back = 0;
    };

    void place_vertices(const GroundMesh& mesh, const MeshView& view);
    void match_edges(const GroundMesh& mesh, Conformity& found);
    void add_edge(std::uint32_t from, std::uint32_t to);
    bool on_border(const glm::dvec2& a, const glm::dvec2& b) const;
    int doubled_vertices();
    int corners_on_open_edges();

    double spacing_m_;
    glm::dvec2 half_extent_m_;
    glm::dvec2 last_; ///< column and row
    std::uint32_t mesh_ = 0;
    std::vector<Edge> edges_; ///< a power of two
    std::vector<Edge> open_;
    std::vector<glm::dvec2> places_; ///< of vertices: samples east, north
    std::vector<std::uint32_t> sorted_;
    std::vector<std::uint8_t> used_;   ///< by vertex: a triangle has it
    std::vector<std::uint32_t> slots_; ///< hash table over places
};

} // namespace octant::visuals::terrain
