#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>

namespace octant::tests {

/// Meshes for tests of simplification, and what must hold of the results.

models::TriangleMesh tetrahedron();
models::TriangleMesh octahedron();

/// A cube of edge 1 with n x n fields a side, closed, seen from outside.
models::TriangleMesh cube(int n);

/// A ring of n x m quads, each cut in two; genus 1.
models::TriangleMesh ring(int n, int m);

/// A ball of n meridians and rings, closed.
models::TriangleMesh ball(int n);

/// A flat piece of n x m fields of edge 1 / n in the plane z = 0, seen from above, with boundary.
models::TriangleMesh strip(int n, int m);

/// A block with a step, rounded on one side, whose edges are sharp: like a part of a machine.
models::TriangleMesh machined_part(int n);

/// Hills of 100 x 100 fields over a unit square, and above them boxes of 12 triangles and this edge.
models::TriangleMesh hills_with_boxes(int boxes, double edge_m);

/// Whether no edge lies in two triangles the same way round, no three vertices form two triangles, and no triangle has
/// a vertex twice.
bool is_manifold(const models::TriangleMesh& mesh);

std::size_t boundary_edges(const models::TriangleMesh& mesh);

/// Vertices - edges + triangles: 2 for a ball, 0 for a ring.
long euler_number(const models::TriangleMesh& mesh);

double area_m2(const models::TriangleMesh& mesh);
double volume_m3(const models::TriangleMesh& mesh);

bool same_bytes(const models::TriangleMesh& a, const models::TriangleMesh& b);

} // namespace octant::tests
