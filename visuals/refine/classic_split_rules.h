#pragma once

#include "visuals/refine/progressive_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::refine {

/// Which neighbourhood must be active before a node may split.
enum class SplitRule {
    Selective, ///< Kim & Lee 2000, 2001: two different active cut vertices.
    Hoppe,     ///< Hoppe 1997: the faces that lay beside the two removed ones at collapse time.
    Xia        ///< Xia & Varshney 1996: all vertices of the 1-ring at collapse time.
};

/// The neighbourhoods that the two earlier rules store for each collapse. They are here so that the
/// three rules can be compared over one hierarchy. Found by replaying all collapses of the mesh
/// once.
class ClassicSplitRules {
public:
    explicit ClassicSplitRules(const ProgressiveMesh& mesh);

    /// The four original faces fn0 to fn3 of Hoppe 1997: the ones across the remaining edges of the
    /// two faces that the collapse removed; `none` on a boundary. `node` is an inner node.
    const std::array<std::uint32_t, 4>& adjacent_faces(std::uint32_t node) const {
        return adjacent_faces_[node - leaves_];
    }

    /// The 1-ring of Xia & Varshney: the nodes around both children when they were collapsed,
    /// ascending.
    std::span<const std::uint32_t> ring(std::uint32_t node) const { return rings_[node - leaves_]; }

    /// The inner node whose split adds an original face to the active mesh; `none` for a face of
    /// the base mesh.
    std::uint32_t introducer(std::uint32_t face) const { return introducers_[face]; }

private:
    std::uint32_t leaves_;
    std::vector<std::array<std::uint32_t, 4>> adjacent_faces_;
    std::vector<std::vector<std::uint32_t>> rings_;
    std::vector<std::uint32_t> introducers_;
};

} // namespace octant::visuals::refine
