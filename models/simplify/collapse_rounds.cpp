// Rounds of collapses by quadrics (M. Garland, P. Heckbert, "Surface Simplification Using Quadric
// Error Metrics", 1997). Instead of always the cheapest edge, a round takes the cheapest part of
// all edges, in the order of memory, and of those only ones neither end of which has moved in the
// same round: their costs are still right.
#include "models/simplify/collapse_rounds.h"

#include "models/simplify/aims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace octant::models::simplify {

namespace {

/// A round tries the cheapest one of so many edges.
constexpr std::size_t edges_a_try = 8;
/// And only those that cost at most so many times what the last round allowed. Where flats are cut
/// into many triangles, each round frees edges on them that cost nothing, and these come first.
constexpr float most_rise = 4.0F;
/// Without such a limit goes the round after one that took less than this share of the triangles
/// away, and rounds end when it does no better.
constexpr double least_progress = 0.01;

class Rounds {
public:
    Rounds(CollapsingSurface& collapsing, const RoundOptions& options)
        : collapsing_(collapsing)
        , surface_(collapsing.surface())
        , options_(options)
        , costs_(3 * surface_.mesh.face_slots(), 0.0F)
        , moved_(surface_.mesh.vertex_slots(), 1) {}

    void run() {
        constexpr float unlimited = std::numeric_limits<float>::infinity();
        float limit = unlimited;
        while (surface_.mesh.face_count() > options_.faces) {
            update_costs();
            std::ranges::fill(moved_, 0);
            const float most = std::min(limit, highest_cost());
            const std::size_t before = surface_.mesh.face_count();
            collapse_below(most);
            const std::size_t taken = before - surface_.mesh.face_count();
            const bool is_slow =
                static_cast<double>(taken) < least_progress * static_cast<double>(before);
            if (is_slow && limit == unlimited) {
                break;
            }
            limit = is_slow ? unlimited : most_rise * most;
            if (2 * surface_.mesh.face_count() < surface_.mesh.face_slots()) {
                compact();
            }
        }
        compact();
    }

private:
    bool is_edge(HalfEdge h) const {
        return surface_.mesh.face_is_there(face_of(h)) && surface_.mesh.edge_of(h) == h;
    }

    void update_costs() {
        const CollapsibleMesh& mesh = surface_.mesh;
        for_face_ranges(mesh, options_.threads, [&](std::uint32_t first, std::uint32_t end) {
            for (HalfEdge h = 3 * first; h < 3 * end; ++h) {
                if (is_edge(h) && (moved_[mesh.origin(h)] != 0 || moved_[mesh.target(h)] != 0)) {
                    const Placement placement = collapsing_.quadrics().placement(surface_, h);
                    costs_[h] = static_cast<float>(placement.cost);
                }
            }
        });
    }

    /// Of the edges that are tried in this round.
    float highest_cost() {
        sorted_.clear();
        for (HalfEdge h = 0; h < costs_.size(); ++h) {
            if (is_edge(h)) {
                sorted_.push_back(costs_[h]);
            }
        }
        const auto last =
            sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / edges_a_try);
        std::nth_element(sorted_.begin(), last, sorted_.end());
        return *last;
    }

    void collapse_below(float most) {
        const CollapsibleMesh& mesh = surface_.mesh;
        for (HalfEdge h = 0; h < costs_.size() && mesh.face_count() > options_.faces; ++h) {
            if (is_edge(h) && costs_[h] <= most && moved_[mesh.origin(h)] == 0 &&
                moved_[mesh.target(h)] == 0 && surface_.may_collapse(h)) {
                try_collapse(h);
            }
        }
    }

    void try_collapse(HalfEdge h) {
        const Placement placement = collapsing_.quadrics().placement(surface_, h);
        surface_.mesh.ring_of(h, ring_);
        const double negligible = options_.low_may_turn ? error_ : 0.0;
        if (!may_move(surface_, ring_, placement.place, options_.strictness, negligible)) {
            return;
        }
        if (placement.weight > 0.0) {
            error_ = std::max(error_, std::sqrt(placement.cost / placement.weight));
        }
        const std::uint32_t kept = surface_.mesh.origin(h);
        collapsing_.collapse(h, placement, error_);
        moved_[kept] = 1;
    }

    void compact() {
        const KeptSlots kept = collapsing_.compact();
        for (std::size_t i = 0; i < kept.faces.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                costs_[3 * i + k] = costs_[3 * std::size_t{kept.faces[i]} + k];
            }
        }
        costs_.resize(3 * kept.faces.size());
        costs_.shrink_to_fit();
        keep_slots(moved_, kept.vertices);
    }

    CollapsingSurface& collapsing_;
    WorkingSurface& surface_;
    const RoundOptions& options_;
    std::vector<float> costs_; ///< For each half-edge that names an edge.
    /// For each vertex slot whether it moved in the last round, or before the first one.
    std::vector<std::uint8_t> moved_;
    std::vector<float> sorted_;
    std::vector<RingFace> ring_;
    double error_ = 0.0; ///< The estimated error so far, in working units.
};

} // namespace

void collapse_in_rounds(CollapsingSurface& collapsing, const RoundOptions& options) {
    Rounds(collapsing, options).run();
}

} // namespace octant::models::simplify
