#pragma once

#include "models/collapse_sequence.h"
#include "models/simplify/collapse_guard.h"
#include "models/simplify/edge_heap.h"
#include "models/simplify/simplify_options.h"
#include "models/simplify/surface_cost.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/vertex_quadrics.h"
#include "models/simplify/working_surface.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace octant::models::simplify {

/// Collapses edges of a surface, the cheapest first.
class CollapseRun {
public:
    /// Quality::Surface needs `points`, the tracked ones of the surface; they and the surface are
    /// changed. `length_share`: as in SimplifyOptions, without points.
    CollapseRun(
        WorkingSurface& surface,
        const WorkingUnits& units,
        TrackedPoints* points,
        double length_share = 0.0);

    /// Goes on until a goal is met or nothing can be collapsed any more. An error goal is compared
    /// with estimates.
    void run(const Goal& goal, const ShowProgress& show_progress);

    std::vector<Collapse>& collapses() { return collapses_; }

private:
    bool is_met(const Goal& goal) const;
    void fill();
    bool next_edge(HalfEdge& h);
    void update_cost(HalfEdge edge);
    double length_cost(HalfEdge edge, const Placement& placement) const;
    double surface_increase(HalfEdge h, const Placement& placement, double enough);
    Placement placed(HalfEdge h) const;
    bool is_allowed(HalfEdge h, const Placement& placement);
    void collapse(HalfEdge h, const Placement& placement);
    void update_around(std::uint32_t vertex);

    WorkingSurface& surface_;
    const WorkingUnits& units_;
    TrackedPoints* points_; ///< null: costs by quadrics
    double length_share_;
    VertexQuadrics quadrics_;
    EdgeHeap heap_;
    std::vector<bool> checked_;          ///< of each edge: cost and permission are those of now
    std::vector<std::uint32_t> numbers_; ///< of each vertex slot, in the sequence
    std::vector<Collapse> collapses_;
    Strictness strictness_;
    bool filled_ = false;
    double error_ = 0.0; ///< estimated, so far
    SurfaceCost cost_;
    std::vector<RingFace> ring_;
    std::vector<std::uint32_t> faces_;
    std::vector<std::uint32_t> ring_faces_;
};

} // namespace octant::models::simplify
