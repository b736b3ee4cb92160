#pragma once

#include "visuals/refine/selective_refiner.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace octant::visuals::refine::test {

using NamedFaces = std::vector<std::array<std::uint32_t, 3>>;

/// Faces of the active mesh by the sequence numbers of their nodes, smallest first in each and sorted.
NamedFaces active_faces(const SelectiveRefiner& refiner);

/// The same computed from the sequence and the list of active nodes alone: original faces with three different active
/// ancestors.
NamedFaces expected_faces(const models::CollapseSequence& sequence, const SelectiveRefiner& refiner);

/// What is wrong with the active mesh as an oriented manifold; empty when nothing is.
std::string manifold_fault(const SelectiveRefiner& refiner);

/// Vertices in use - edges + faces.
long euler_characteristic(const NamedFaces& faces);

} // namespace octant::visuals::refine::test
