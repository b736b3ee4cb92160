#pragma once

#include "models/collapse_sequence.h"

#include <cstdint>

namespace octant::visuals::refine::test {

/// A closed sphere of radius 1: an octahedron whose faces are cut into 4 `cuts` times.
models::TriangleMesh made_sphere(int cuts);

/// A closed torus of radii 1 and 0.4 with `around` x `across` vertices.
models::TriangleMesh made_torus(std::uint32_t around, std::uint32_t across);

/// A level grid of `size` x `size` vertices 1 m apart, with boundary, coloured by place.
models::TriangleMesh made_grid(std::uint32_t size);

/// The same with heights up to 1 m, any by `seed`.
models::TriangleMesh made_ground(std::uint32_t size, std::uint64_t seed);

/// Collapses the shortest edge into its middle until none is left that the link condition allows. Errors add half the
/// edge's length to the larger one of both ends'.
models::CollapseSequence collapsed(models::TriangleMesh mesh);

/// The same for max_collapses at most.
models::CollapseSequence collapsed(models::TriangleMesh mesh, std::size_t max_collapses);

} // namespace octant::visuals::refine::test
