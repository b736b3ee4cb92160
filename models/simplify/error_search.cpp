#include "models/simplify/error_search.h"

#include "models/measure/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace octant::models::simplify {

namespace {

/// A wanted error may take this many tries, each with an optimization and a certified distance.
constexpr int most_tries = 6;
/// Another try is made only while more than this share of the faces is in question.
constexpr double close_enough = 0.03;

class ErrorSearch {
public:
    ErrorSearch(
        const CollapseSequence& sequence,
        const SimplifyOptions& options,
        const MeshAfter& finished_after)
        : sequence_(sequence)
        , options_(options)
        , finished_after_(finished_after)
        , error_m_(*options.goal.error_m)
        , too_many_(sequence.collapses.size() + 1) {}

    KeptError find() {
        best_ = finished_after_(0);
        std::size_t next = first_guess();
        // More than most_tries are made only while nothing has been found that keeps the error.
        for (int tries = 0; next != fits_ && (tries < most_tries || fits_ == 0); ++tries) {
            tell(next);
            next = next_guess();
        }
        return {fits_, std::move(best_)};
    }

private:
    /// Tries aim at this share of the wanted error.
    static constexpr double aim = 0.97;
    /// The number of faces is assumed to grow with this power of 1 / error.
    static constexpr double steepness = 1.5;
    /// The first try is where the estimate reaches this many times the wanted error, which the
    /// optimization lowers.
    static constexpr double first_try = 1.2;

    /// The number of collapses of the first try, from the estimates in the sequence.
    std::size_t first_guess() const {
        const auto& all = sequence_.collapses;
        const double estimate_m =
            first_try * error_m_;
        const auto over = std::ranges::find_if(
            all, [estimate_m](const Collapse& collapse) { return collapse.error_m > estimate_m; });
        return static_cast<std::size_t>(over - all.begin());
    }

    /// Tries a number of collapses and narrows the range.
    void tell(std::size_t collapses) {
        TriangleMesh mesh = finished_after_(collapses);
        const measure::MeshDistance distance = measure::distance(
            sequence_.original,
            mesh,
            {.tightness = 1.03,
             .negligible_m = 0.9 * error_m_,
             .samples = 100,
             .threads = options_.threads,
             .larger_alone = true});
        const double about_m = 0.5 * (distance.least_hausdorff_m() + distance.most_hausdorff_m());
        likely_faces_ = faces_after(collapses) *
                        std::clamp(std::pow(about_m / (aim * error_m_), steepness), 0.4, 2.5);
        if (distance.most_hausdorff_m() * measure::DistanceOptions().tightness <= error_m_) {
            fits_ = collapses;
            best_ = std::move(mesh);
        } else {
            too_many_ = collapses;
        }
    }

    /// The number of faces after so many collapses.
    double faces_after(std::size_t collapses) const {
        double faces = static_cast<double>(sequence_.original.triangles.size());
        for (std::size_t i = 0; i < collapses; ++i) {
            const Collapse& collapse = sequence_.collapses[i];
            faces -= collapse.left != none ? 1.0 : 0.0;
            faces -= collapse.right != none ? 1.0 : 0.0;
        }
        return std::max(faces, 1.0);
    }

    /// The number of collapses to try next: where the last try suggests, if that is well inside the
    /// range; else half of the range in the logarithm of the number of faces. Returns fits_ when
    /// the range is narrow enough.
    std::size_t next_guess() const {
        if (too_many_ - fits_ <= 1) {
            return fits_;
        }
        const bool open = too_many_ > sequence_.collapses.size();
        const double most = faces_after(fits_);
        const double least = faces_after(std::min(too_many_, sequence_.collapses.size()));
        if (!open && most <= least * (1.0 + close_enough)) {
            return fits_;
        }
        const double inside = 1.0 + 0.3 * close_enough;
        const bool likely = likely_faces_ * inside < most && likely_faces_ > least * inside;
        const double wanted = likely ? likely_faces_ : std::sqrt(most * least);
        const std::size_t guess = collapses_to_faces(sequence_, static_cast<std::size_t>(wanted));
        return std::clamp(guess, fits_ + 1, too_many_ - 1);
    }

    const CollapseSequence& sequence_;
    const SimplifyOptions& options_;
    const MeshAfter& finished_after_;
    double error_m_;
    /// The number of faces that the last try suggests.
    double likely_faces_ = 0.0;
    /// The most collapses known to keep the wanted error.
    std::size_t fits_ = 0;
    /// The fewest collapses known not to keep it.
    std::size_t too_many_;
    TriangleMesh best_;
};

} // namespace

KeptError max_collapses_within(
    const CollapseSequence& sequence,
    const SimplifyOptions& options,
    const MeshAfter& finished_after) {
    return ErrorSearch(sequence, options, finished_after).find();
}

} // namespace octant::models::simplify
