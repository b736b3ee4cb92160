#pragma once

#include "visuals/refine/progressive_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <malloc.h>
#include <memory>
#include <string>
#include <vector>

namespace octant::tests::peers {

using Hierarchy = std::shared_ptr<const visuals::refine::ProgressiveMesh>;

/// Faces by the numbers of the original vertices (leaves) at their corners, smallest first, sorted.
using FaceSet = std::vector<std::array<std::uint32_t, 3>>;

/// One way to rebuild the whole original mesh from the base mesh.
class PeerRefinement {
public:
    PeerRefinement() = default;
    PeerRefinement(const PeerRefinement&) = delete;
    PeerRefinement& operator=(const PeerRefinement&) = delete;
    virtual ~PeerRefinement() = default;

    /// Back to the base mesh.
    virtual void restart() = 0;

    /// Splits all inner nodes; the time that this takes is what is compared.
    virtual void split_all() = 0;

    virtual FaceSet faces() const = 0;

    std::string name;
    double heap_bytes = 0.0; ///< at full resolution, what the hierarchy holds included
};

/// Orders of the splits.
enum class SplitOrder {
    CoarseFirst, ///< as the simplification went, backwards
    BySubtree    ///< a node's subtree before the next node
};

inline std::vector<std::uint32_t> split_order(const visuals::refine::ProgressiveMesh& mesh, SplitOrder order) {
    std::vector<std::uint32_t> nodes = mesh.coarsest_first();
    if (order == SplitOrder::BySubtree) { std::sort(nodes.rbegin(), nodes.rend()); }
    return nodes;
}

/// `together`: handed over in one call.
std::unique_ptr<PeerRefinement> our_refinement(const Hierarchy& mesh, SplitOrder order, bool together);

/// OpenMesh's view-dependent progressive meshes over the same hierarchy. Throws std::runtime_error where its node
/// numbers have too few bits for the hierarchy's depth.
std::unique_ptr<PeerRefinement> openmesh_refinement(const Hierarchy& mesh, SplitOrder order);

inline void sort_faces(FaceSet& faces) {
    for (auto& face : faces) {
        while (face[0] > face[1] || face[0] > face[2]) { face = {face[1], face[2], face[0]}; }
    }
    std::sort(faces.begin(), faces.end());
}

inline double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Bytes handed out by malloc, blocks of their own (mmap) included.
inline double heap_bytes_now() {
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

} // namespace octant::tests::peers
