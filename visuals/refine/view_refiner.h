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
    double error_px = 1.0;    ///< what shows a larger error is split
    double merge_share = 0.6; ///< of error_px: what shows a smaller one is merged, < 1
    int rest_frames = 10;     ///< a node that was split is not merged for so many
    /// Nor is one that was merged split again for so many, unless a neighbour or a turned face
    /// needs it or it shows more than again_share times error_px.
    double again_share = 1.5;
    std::size_t operations = 2000; ///< splits and collapses asked for in a frame, at most
    bool geomorphs = true;
    CriterionOptions criterion{};
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
    std::vector<std::uint32_t> split_frames_; ///< one a slot: when its node came
    std::vector<Merged> merged_;              ///< one a slot: what was last merged there
};

} // namespace octant::visuals::refine
