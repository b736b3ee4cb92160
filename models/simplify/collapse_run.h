#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/simplify/collapse_guard.h"
#include "models/simplify/collapsing_surface.h"
#include "models/simplify/edge_heap.h"
#include "models/simplify/simplify_options.h"
#include "models/simplify/surface_cost.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/triangle_samples.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace octant::models::simplify {

/// The guard at the beginning. The plain ways to choose an edge have none against slivers, which
/// lie best along cylinders and rims, but where states between are shown.
Strictness
first_strictness(const WorkingSurface& surface, Chooser chooser, const SimplifyOptions& options);

/// The greedy loop of edge collapses: always the cheapest edge next.
class CollapseRun {
public:
    /// `points`, the tracked points of the surface, serve choosers that measure distances and are
    /// null for others (asserted). Of the options length_share, low_may_turn and avoided_m count.
    /// The surface and the points are changed by run().
    /// `tree`, over the original in working units, is asked where options.avoided_m is finite.
    CollapseRun(
        CollapsingSurface& collapsing,
        Chooser chooser,
        TrackedPoints* points,
        const measure::TriangleBvh* tree,
        const SimplifyOptions& options);

    /// Collapses edges until the goal is met or no edge may be collapsed any more. A goal of an
    /// error is compared with the run's own estimate, not with a certified distance.
    void run(const Goal& goal, const ShowProgress& show_progress);

private:
    bool is_met(const Goal& goal) const;
    void fill();
    void fill_again();
    bool next_edge(HalfEdge& h);
    HalfEdge taking_one(HalfEdge h);
    void update_cost(HalfEdge edge);
    double length_cost(HalfEdge edge, const Placement& placement) const;
    double surface_increase(HalfEdge h, const Placement& placement);
    double surface_cost(HalfEdge h, const Placement& placement);
    double peak_cost() const;
    double avoided_cost() const;
    bool leads_too_far(HalfEdge h);
    Placement placed(HalfEdge h);
    bool is_allowed(HalfEdge h, const Placement& placement);
    void collapse(HalfEdge h, const Placement& placement);
    void update_around(std::uint32_t vertex);

    CollapsingSurface& collapsing_;
    WorkingSurface& surface_;
    Chooser chooser_;
    TrackedPoints* points_; ///< Null unless distances are measured.
    double length_share_;
    bool low_may_turn_;
    EdgeHeap heap_;
    /// For each vertex slot whether edges at it may have been taken out of the heap; kept for
    /// choosers that sum planes, which have nothing else to do one ring further.
    std::vector<bool> has_parked_;
    std::vector<bool> checked_; ///< For each edge whether its cost and permission are up to date.
    /// For each checked edge whether the way back to the original was looked at, too.
    std::vector<bool> looked_back_;
    const measure::TriangleBvh* tree_;
    std::vector<TriangleSample> back_samples_;
    Strictness strictness_;
    bool filled_ = false;
    double error_ = 0.0;   ///< The estimated error so far, in working units.
    double squares_ = 0.0; ///< The sum of squared distances so far, weighted by area.
    double area_ = 0.0;    ///< The area that this sum runs over.
    double avoided2_;      ///< Squared distances beyond this are avoided; working units.
    double filled_at_;     ///< The error when edges that were not allowed were last looked at.
    SurfaceCost cost_;
    std::vector<RingFace> ring_;
    std::vector<std::uint32_t> faces_;
    std::vector<std::uint32_t> ring_faces_;
};

} // namespace octant::models::simplify
