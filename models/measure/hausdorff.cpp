// The one-sided Hausdorff distance with certified bounds, by branch and bound over the triangles of
// one mesh: M. Guthe, P. Borodin, R. Klein, "Fast and accurate Hausdorff distance calculation
// between meshes", 2005. Every sampled point gives a lower bound; each piece of a triangle has an
// upper bound; the piece with the largest is cut in two until the bounds are close.
//
// The upper bound of a piece: the distance to a convex set is a convex function, so that over a
// triangular piece it is at most its largest value at the corners. A single triangle T of the
// target is convex, and the distance to the target is at most that to T. Asked are the T nearest to
// the corners and to the centre of the piece. Beside that, the distance changes no faster than a
// point moves.
//
// Deviations:
// - The bound of a piece is the one above, not one from a voxel grid.
// - Pieces are cut in two, not in four, and where they leave the part of space over one T. So a
//   piece that lies flat on many triangles ends as the overlay of both meshes and not in pieces of
//   the size of the distance. Elsewhere the cut is where the nearest triangle changes.
// - Pieces are cut in batches, so that the result is the same on any number of threads.
#include "models/measure/hausdorff.h"

#include "models/measure/surface_piece.h"
#include "sim/base/worker_team.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <utility>
#include <vector>

namespace octant::models::measure {

namespace {

/// A triangular piece of the surface, its corners given as indices of samples.
struct Piece {
    std::array<std::uint32_t, 3> corners{};
    double most_m = 0.0; ///< No point of the piece is farther from the target than this.
    /// The target's triangle nearest to the centre of the piece, where known.
    std::uint32_t middle = NearestOnMesh::none;
};

/// The order of the heap of open pieces: the one with the largest bound is on top.
bool nearer(const Piece& one, const Piece& other) {
    return one.most_m < other.most_m;
}

/// One branch-and-bound search.
class Search {
public:
    Search(const TriangleMesh& mesh, const TargetSurface& target, const HausdorffLimits& limits)
        : mesh_(mesh)
        , target_(target)
        , limits_(limits) {}

    HausdorffBounds run();

private:
    /// The two parts of a piece that was cut, and the sample where it was cut.
    struct Halves {
        Sample between;
        std::array<Piece, 2> pieces; ///< A corner numbered `fresh` is the sample `between`.
        double least_m = 0.0;
    };

    static constexpr std::uint32_t fresh = NearestOnMesh::none;
    static constexpr std::size_t chunk = 64;
    static constexpr std::size_t batch = 1024;

    /// Pieces whose bound is below this need not be cut any further.
    double enough_m() const { return std::max(limits_.negligible_m, limits_.tightness * least_m_); }

    /// The samples at the corners of a piece; `between` stands for a fresh corner.
    Corners corners_of(const Piece& piece, const Sample* between = nullptr) const;
    /// Measures the distances of all vertices that triangles use.
    void measure_vertices();
    /// Bounds all triangles and keeps those that may hold the largest distance.
    void take_triangles();
    /// Cuts a piece in two and bounds both parts. Changes nothing, so that threads may share the
    /// work.
    Halves cut(const Piece& piece, double enough_m) const;
    /// Cuts the open pieces with the largest bounds, a whole batch against the same lower bound.
    void cut_batch();
    /// Puts a piece onto the heap unless its bound is low enough.
    void keep(const Piece& piece);

    /// Calls `work(first, last)` for chunks of 0 to `count`, on several threads.
    template <typename Work>
    void in_chunks(std::size_t count, const Work& work) const {
        share_out((count + chunk - 1) / chunk, limits_.threads, [&](std::size_t i, std::size_t) {
            work(i * chunk, std::min(count, (i + 1) * chunk));
        });
    }

    const TriangleMesh& mesh_;
    const TargetSurface& target_;
    const HausdorffLimits& limits_;
    std::vector<Sample> samples_; ///< The mesh's vertices first, then one for each cut.
    std::vector<Piece> open_;     ///< A heap; the piece with the largest bound is on top.
    double least_m_ = 0.0;
    double left_out_m_ = 0.0; ///< The largest bound of the pieces that were left out.
    std::size_t cuts_ = 0;
};

Corners Search::corners_of(const Piece& piece, const Sample* between) const {
    Corners corners{};
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = piece.corners[i] == fresh ? between : &samples_[piece.corners[i]];
    }
    return corners;
}

void Search::measure_vertices() {
    std::vector<char> used(mesh_.vertices_m.size(), 0);
    for (const Triangle& triangle : mesh_.triangles) {
        for (const std::uint32_t vertex : triangle) {
            used[vertex] = 1;
        }
    }
    samples_.resize(used.size());
    in_chunks(used.size(), [&](std::size_t first, std::size_t last) {
        std::uint32_t guess = NearestOnMesh::none;
        for (std::size_t i = first; i < last; ++i) {
            if (used[i] != 0) {
                samples_[i] = measured(target_, mesh_.vertices_m[i], guess);
                guess = samples_[i].nearest;
            }
        }
    });
    for (const Sample& sample : samples_) {
        least_m_ = std::max(least_m_, sample.distance_m);
    }
}

void Search::keep(const Piece& piece) {
    if (piece.most_m <= enough_m()) {
        left_out_m_ = std::max(left_out_m_, piece.most_m);
    } else {
        open_.push_back(piece);
        std::ranges::push_heap(open_, nearer);
    }
}

void Search::take_triangles() {
    std::vector<PieceBounds> bounds(mesh_.triangles.size());
    in_chunks(bounds.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            bounds[i] = bounds_of(target_, corners_of({.corners = mesh_.triangles[i]}), enough_m());
        }
    });
    for (const PieceBounds& one : bounds) {
        least_m_ = std::max(least_m_, one.least_m);
    }
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        keep({mesh_.triangles[i], bounds[i].most_m, bounds[i].middle});
    }
}

Search::Halves Search::cut(const Piece& piece, double enough_m) const {
    const Corners corners = corners_of(piece);
    const Cut where = cut_of(target_, corners, piece.middle, enough_m);
    const std::size_t next = (where.edge + 1) % 3;
    Halves halves;
    halves.between = measured(
        target_,
        glm::mix(corners[where.edge]->point, corners[next]->point, where.along),
        corners[where.along < 0.5 ? where.edge : next]->nearest);
    halves.pieces = {piece, piece};
    halves.pieces[0].corners[next] = fresh;
    halves.pieces[1].corners[where.edge] = fresh;
    for (Piece& half : halves.pieces) {
        const PieceBounds bounds = bounds_of(target_, corners_of(half, &halves.between), enough_m);
        half.most_m = std::min(piece.most_m, bounds.most_m);
        half.middle = bounds.middle;
        halves.least_m = std::max(halves.least_m, bounds.least_m);
    }
    return halves;
}

void Search::cut_batch() {
    std::vector<Piece> pieces;
    while (!open_.empty() && pieces.size() < batch && open_.front().most_m > enough_m()) {
        std::ranges::pop_heap(open_, nearer);
        pieces.push_back(open_.back());
        open_.pop_back();
    }
    const double enough = enough_m();
    std::vector<Halves> halves(pieces.size());
    in_chunks(pieces.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            halves[i] = cut(pieces[i], enough);
        }
    });
    cuts_ += pieces.size();
    for (const Halves& pair : halves) {
        least_m_ = std::max(least_m_, pair.least_m);
    }
    for (Halves& pair : halves) {
        const auto between = static_cast<std::uint32_t>(samples_.size());
        samples_.push_back(pair.between);
        for (Piece& piece : pair.pieces) {
            std::ranges::replace(piece.corners, fresh, between);
            keep(piece);
        }
    }
}

HausdorffBounds Search::run() {
    measure_vertices();
    take_triangles();
    while (!open_.empty() && open_.front().most_m > enough_m() && cuts_ < limits_.cuts) {
        cut_batch();
    }
    const double open_m = open_.empty() ? 0.0 : open_.front().most_m;
    return {least_m_, std::max({least_m_, left_out_m_, open_m}), cuts_};
}

} // namespace

HausdorffBounds one_way_hausdorff(
    const TriangleMesh& mesh, const TargetSurface& target, const HausdorffLimits& limits) {
    assert(!mesh.triangles.empty() && !target.mesh().triangles.empty());
    const Bounds extent = models::bounds_of(mesh);
    const glm::dvec3 farthest = glm::max(glm::abs(extent.least_m), glm::abs(extent.most_m));
    const double rounding_m =
        target.bvh().rounding_m() + 256.0 * std::numeric_limits<double>::epsilon() *
                                        std::max({farthest.x, farthest.y, farthest.z});
    HausdorffLimits wanted = limits;
    wanted.negligible_m = std::max(limits.negligible_m, 4.0 * rounding_m);
    HausdorffBounds bounds = Search(mesh, target, wanted).run();
    bounds.least_m = std::max(0.0, bounds.least_m - rounding_m);
    bounds.most_m += rounding_m;
    return bounds;
}

} // namespace octant::models::measure
