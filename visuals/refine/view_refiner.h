#pragma once

#include "visuals/refine/geomorphs.h"
#include "visuals/refine/refine_criterion.h"
#include "visuals/refine/selective_refiner.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace octant::visuals::refine {

struct ViewRefinerOptions {
    double error_px = 1.0;       ///< what shows a larger error is split
    double merge_share = 0.75;   ///< of error_px: what shows a smaller one is merged, < 1
    double merge_play_rad = 0.2; ///< criterion.play_rad for merges: what comes into sight keeps
    int rest_frames = 10;        ///< a node that was split is not merged for so many
    /// Nor is one that was merged split again for so many, nor another one that forces it, unless
    /// that one shows more than again_share times error_px or nothing else mends a turned face.
    double again_share = 3.0;
    std::size_t operations = 2000; ///< splits and collapses asked for in a frame, at most
    bool geomorphs = true;
    CriterionOptions criterion{}; ///< of splits
    GeomorphOptions geomorph{};
    bool repair = true; ///< of fold-overs
};

/// What a frame did.
struct RefinedFrame {
    std::size_t splits = 0; ///< forced ones included
    std::size_t collapses = 0;
    std::size_t moving = 0; ///< vertices that moved
    bool settled = true;    ///< nothing is left to do for this view
};

/// Keeps a front as fine as a view needs it. Several of them may share a hierarchy. The same views
/// give the same meshes.
class ViewRefiner {
public:
    explicit ViewRefiner(
        std::shared_ptr<const ProgressiveMesh> mesh, const ViewRefinerOptions& options = {});

    /// One frame. Worst errors are split first, smallest ones merged first. With a settled view
    /// nothing is looked at but the view.
    RefinedFrame update(const RefineView& view);

    /// Makes the mesh fit a view at once, without moves and however many operations it takes: for
    /// the first picture that shows it.
    void settle(const RefineView& view);

    const SelectiveRefiner& front() const { return front_; }

    SelectiveRefiner& front() { return front_; }

    /// Whether the criterion alone keeps a node split in the view of the last frame.
    bool keeps_split(std::uint32_t node) const {
        return merged_error_px(node) >= options_.merge_share * options_.error_px;
    }

    /// Inner nodes that the criterion alone wants split for a view.
    std::size_t wanted_splits(const RefineView& view) const;

private:
    struct Candidate {
        double error_px = 0.0;
        std::uint32_t node = none;
    };

    double error_px(std::uint32_t node) const {
        return projected_error_px(front_.mesh(), node, view_, options_.criterion);
    }

    /// What a node would show once its children are merged into it, with play.
    double merged_error_px(std::uint32_t node) const {
        CriterionOptions criterion = options_.criterion;
        criterion.play_rad += options_.merge_play_rad;
        return projected_error_px(front_.mesh(), node, view_, criterion);
    }

    struct Merged {
        std::uint32_t node = none;
        std::uint32_t frame = 0;
    };

    void gather();
    void consider_split(std::uint32_t node);
    void split_worst();
    void start_moves();
    void turn_back_moves();
    void merge_smallest();
    bool merge(std::uint32_t node);
    bool is_resting(std::uint32_t node) const;
    bool rests_after_merge(std::uint32_t node) const;
    bool needs_resting(std::uint32_t node);

    ViewRefinerOptions options_;
    SelectiveRefiner front_;
    Geomorphs moves_;
    RefineView view_;
    bool has_view_ = false;
    bool settled_ = false;
    bool waiting_ = false; ///< something is left for the next frame
    std::uint32_t frame_ = 0;
    std::vector<Candidate> splits_; ///< a heap, the worst on top
    std::vector<Candidate> merges_;
    std::vector<std::uint32_t> turning_;      ///< slots
    std::vector<std::uint32_t> forced_;       ///< of needs_resting
    std::vector<std::uint32_t> split_frames_; ///< one a slot: when its node came
    std::vector<Merged> merged_;              ///< one a slot: what was last merged there
};

} // namespace octant::visuals::refine
