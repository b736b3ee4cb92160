#pragma once

#include "models/collapse_sequence.h"
#include "models/simplify/local_error.h"
#include "models/simplify/quadrics.h"
#include "models/simplify/simplify_options.h"
#include "models/simplify/surface_samples.h"
#include "models/simplify/working_surface.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::models::simplify {

/// A surface whose edges collapse, with the quadrics of its vertices and the record of collapses, which uses the
/// numbers of the initial mesh.
class CollapsingSurface {
public:
    CollapsingSurface(WorkingSurface surface, const WorkingUnits& units, const EdgeWeights& weights);

    WorkingSurface& surface() { return surface_; }

    const WorkingSurface& surface() const { return surface_; }

    const WorkingUnits& units() const { return units_; }

    const VertexQuadrics& quadrics() const { return quadrics_; }

    /// Collapses an edge, which must be allowed, merges the quadrics of its ends and records it. `error` is the
    /// estimated error so far, in working units. After a cut handle the record is not a valid sequence of collapses.
    CollapseEffect collapse(HalfEdge h, const VertexPlacement& placement, double error);

    /// The numbers of holes closed and handles cut.
    std::size_t holes_closed() const { return holes_closed_; }

    std::size_t handles_cut() const { return handles_cut_; }

    /// Frees the slots of removed vertices and triangles; the order of the rest stays.
    SlotMap compact();

    /// The number of vertices of the initial mesh.
    std::size_t first_vertices() const { return first_vertices_; }

    /// The recorded collapses, in file units.
    std::vector<Collapse>& collapses() { return collapses_; }

    const std::vector<Collapse>& collapses() const { return collapses_; }

    /// For each vertex slot its number in the collapse sequence.
    const std::vector<std::uint32_t>& vertex_numbers() const { return vertex_numbers_; }

    /// For each triangle slot its number in the initial mesh.
    const std::vector<std::uint32_t>& face_numbers() const { return face_numbers_; }

private:
    void copy_vertex(std::uint32_t from, std::uint32_t to);

    WorkingSurface surface_;
    WorkingUnits units_;
    VertexQuadrics quadrics_;
    std::vector<std::uint32_t> vertex_numbers_;
    std::vector<std::uint32_t> face_numbers_; ///< for each triangle slot its number in the initial mesh
    std::size_t first_vertices_;
    std::vector<Collapse> collapses_;
    std::size_t holes_closed_ = 0;
    std::size_t handles_cut_ = 0;
};

/// Collapses the edge with the least quadric error, until the goal is met or no edge can collapse.
void collapse_by_quadrics(CollapsingSurface& collapsing, const Goal& goal, const SimplifyOptions& options);

/// Collapses the edge with the least growth of the error against samples of the original. Each sample must be in the
/// list of a nearby triangle. Unless the options forbid it, holes are closed, handles cut and shells dropped when that
/// is cheaper; with an error limit, shells that keep it are also dropped at the end. Returns the number of shells
/// dropped.
std::size_t collapse_by_samples(CollapsingSurface& collapsing, SurfaceSamples& samples, const OriginalSurface& original,
    const Goal& goal, const SimplifyOptions& options);

} // namespace octant::models::simplify
