#pragma once

#include "models/collapse_sequence.h"
#include "models/simplify/local_error.h"
#include "models/simplify/simplify_options.h"
#include "models/simplify/surface_samples.h"
#include "models/simplify/vertex_quadrics.h"
#include "models/simplify/working_surface.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::models::simplify {

/// A surface whose edges collapse one after the other: with it go the quadrics of its vertices and the record of what
/// collapsed, in the numbers of the mesh that it was at first.
class CollapsingSurface {
public:
    CollapsingSurface(WorkingSurface surface, const WorkingUnits& units, const EdgeWeights& weights);

    WorkingSurface& surface() { return surface_; }

    const WorkingSurface& surface() const { return surface_; }

    const WorkingUnits& units() const { return units_; }

    const VertexQuadrics& quadrics() const { return quadrics_; }

    /// Collapses an edge that may collapse, merges the quadrics of its ends and records it. `error` is the estimated
    /// error so far, in working units. Where that cuts a handle, the record is no sequence of collapses any more.
    CollapseEffect collapse(HalfEdge h, const VertexPlacement& placement, double error);

    /// The number of holes closed and of handles cut so far.
    std::size_t holes_closed() const { return holes_closed_; }

    std::size_t handles_cut() const { return handles_cut_; }

    /// Gives the slots of what is gone back and keeps the order of the rest.
    SlotMap compact();

    /// The vertices of the mesh at first.
    std::size_t first_vertices() const { return first_vertices_; }

    /// The collapses so far, in file units: the progressive mesh in reverse.
    std::vector<Collapse>& collapses() { return collapses_; }

    const std::vector<Collapse>& collapses() const { return collapses_; }

    /// For each vertex slot its number in the collapse sequence.
    const std::vector<std::uint32_t>& vertex_numbers() const { return vertex_numbers_; }

    /// For each triangle slot its number in the mesh at first.
    const std::vector<std::uint32_t>& face_numbers() const { return face_numbers_; }

private:
    void copy_vertex(std::uint32_t from, std::uint32_t to);

    WorkingSurface surface_;
    WorkingUnits units_;
    VertexQuadrics quadrics_;
    std::vector<std::uint32_t> vertex_numbers_;
    std::vector<std::uint32_t> face_numbers_; ///< For each triangle slot its number at first.
    std::size_t first_vertices_;
    std::vector<Collapse> collapses_;
    std::size_t holes_closed_ = 0;
    std::size_t handles_cut_ = 0;
};

/// Collapses edges, the cheapest first by quadrics, until the goal is met or no edge can collapse.
void collapse_by_quadrics(CollapsingSurface& collapsing, const Goal& goal, const SimplifyOptions& options);

/// The same, the cheapest first by the growth of the error against samples of the original. Each sample must be in the
/// list of a triangle that is near. Holes are closed, handles cut and shells dropped where that is cheaper, unless the
/// options keep them. For a wanted error only holes are closed, as a record of collapses cannot hold the rest. Returns
/// how many shells were dropped.
std::size_t collapse_by_samples(CollapsingSurface& collapsing, SurfaceSamples& samples, const OriginalSurface& original,
    const Goal& goal, const SimplifyOptions& options);

} // namespace octant::models::simplify
