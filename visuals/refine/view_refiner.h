#pragma once

#include "visuals/refine/mesh_textures.h"
#include "visuals/refine/refine_criterion.h"
#include "visuals/refine/selective_refiner.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace octant::visuals::refine {

/// How fast vertices travel.
struct GeomorphOptions {
    /// The largest motion of a vertex on the screen in one frame, as seen from a fixed eye.
    double step_px = 0.6;
    /// A move takes at least this many frames.
    double frames = 8.0;
};

/// The vertices that are in motion (H. Hoppe's geomorphs), so that splits and collapses do not pop. After a split, both
/// children start where their parent was drawn and travel to their own positions. Before a collapse, both travel to the
/// parent's position, and only then is the edge collapsed.
class Geomorphs {
public:
    /// `textures`: the pictures on the hierarchy, on which vertices travel, too; null: none. They must outlive it.
    explicit Geomorphs(GeomorphOptions options, const MeshTextures* textures = nullptr)
        : options_(options), textures_(textures) {}

    /// Starts the two vertices of a node that was just split from where that node's vertex was drawn. To be called once
    /// for each split, in the order of the splits.
    void start(const SelectiveRefiner& refiner, std::uint32_t split_node);

    /// Sends the vertex of an active node to the position of node `target`, which is the node itself or its parent.
    void retarget(const SelectiveRefiner& refiner, std::uint32_t slot, std::uint32_t target);

    /// The node to whose position a slot's vertex travels; `none` when it rests at its own node.
    std::uint32_t target(std::uint32_t slot) const;

    /// Whether a slot's vertex is at the position it was sent to.
    bool has_arrived(std::uint32_t slot) const;

    /// Where a slot's vertex is drawn on the picture of a chart that its node touches. Needs textures.
    glm::vec2 place(const SelectiveRefiner& refiner, std::uint32_t slot, std::uint32_t chart) const;

    /// Ends the motion of a slot's vertex: it is drawn at its node from now on.
    void forget(std::uint32_t slot);

    /// Advances all vertices in motion by one frame and puts them into the refiner's vertex array. Returns how many
    /// have moved.
    std::size_t move(SelectiveRefiner& refiner, const RefineView& view);

    /// Ends the motion of all vertices.
    void clear() {
        moves_.clear();
        places_.clear();
    }

    /// Calls use(slot, target) for each vertex in motion.
    template <class Use>
    void each(const Use& use) const {
        for (const Move& move : moves_) { use(move.slot, move.target); }
    }

private:
    struct Move {
        std::uint32_t slot = none;
        std::uint32_t target = none;
        RefinedVertex from;
        double share = 0.0; ///< The share of the way that is done, 0 to 1.
        /// Where it started on the pictures of all charts that its node touches, by ascending charts; with textures
        /// only.
        std::vector<ChartPlace> from_places = {};
    };

    Move* find(std::uint32_t slot);
    const Move* find(std::uint32_t slot) const;
    void add(const Move& move);
    RefinedVertex drawn(const SelectiveRefiner& refiner, const Move& move) const;
    std::vector<ChartPlace> drawn_places(std::uint32_t node, const Move* move) const;

    GeomorphOptions options_;
    const MeshTextures* textures_ = nullptr;
    std::vector<Move> moves_;
    std::vector<std::uint32_t> places_; ///< For each slot its index in moves_, or `none`.
};

/// When nodes are split and collapsed, and how fast.
struct ViewRefinerOptions {
    double error_px = 1.0; ///< A node with a larger projected error is split.
    /// The children of a node with a projected error below this share of error_px collapse into it; below 1.
    double collapse_error_ratio = 0.75;
    /// CriterionOptions::angle_margin_rad for collapses, so that a node that may soon come into sight stays split.
    double collapse_angle_margin_rad = 0.2;
    /// After a split its children do not collapse for this many frames.
    int rest_frames = 10;
    /// After a collapse the node is not split again for rest_frames either, nor is another node whose split would force
    /// that. Exceptions: its error is more than this many times error_px, or nothing else mends a turned face.
    double resplit_error_ratio = 3.0;
    /// At most this many splits and this many collapses are begun in one frame.
    std::size_t operations = 2000;
    bool geomorphs = true;
    CriterionOptions criterion{}; ///< The weights for splits.
    GeomorphOptions geomorph{};
    bool repair = true; ///< Mends fold-overs.
};

/// What one frame did.
struct RefinedFrame {
    std::size_t splits = 0; ///< Forced splits included.
    std::size_t collapses = 0;
    std::size_t moving = 0; ///< The number of vertices that moved.
    bool settled = true;    ///< Nothing is left to do for this view.
};

/// Keeps a front as fine as a view demands, frame after frame, with geomorphs. Several refiners may share a hierarchy.
/// The same sequence of views gives the same meshes.
class ViewRefiner {
public:
    /// `textures`: the pictures on the mesh; null: none.
    explicit ViewRefiner(std::shared_ptr<const ProgressiveMesh> mesh, const ViewRefinerOptions& options = {},
        std::shared_ptr<const MeshTextures> textures = {});

    /// Advances by one frame: splits the largest errors, mends fold-overs, collapses the smallest errors and
    /// moves vertices. While the view does not change and everything is settled, nothing is computed.
    RefinedFrame update(const RefineView& view);

    /// Makes the mesh fit a view at once, without geomorphs and with any number of operations: for the first picture
    /// that shows it.
    void refine_fully(const RefineView& view);

    /// Returns to the base mesh and forgets all frames, as in a new refiner. Memory is kept.
    void restart();

    /// Where a slot's vertex is drawn on the picture of a chart that its node touches. Needs textures.
    glm::vec2 place_on_picture(std::uint32_t slot, std::uint32_t chart) const {
        return moves_.place(refiner_, slot, chart);
    }

    const SelectiveRefiner& front() const { return refiner_; }

    SelectiveRefiner& front() { return refiner_; }

    /// Whether the criterion alone keeps a node split in the view of the last frame.
    bool keeps_split(std::uint32_t node) const {
        return collapsed_error_px(node) >= options_.collapse_error_ratio * options_.error_px;
    }

private:
    /// A node with its projected error.
    struct Candidate {
        double error_px = 0.0;
        std::uint32_t node = none;
    };

    static bool has_smaller_error(const Candidate& a, const Candidate& b) {
        return a.error_px != b.error_px ? a.error_px < b.error_px : a.node < b.node;
    }

    double error_px(std::uint32_t node) const {
        return projected_error_px(refiner_.mesh(), node, view_, options_.criterion);
    }

    /// The projected error of a node after its children have collapsed into it, with collapse_angle_margin_rad.
    double collapsed_error_px(std::uint32_t node) const {
        CriterionOptions criterion = options_.criterion;
        criterion.angle_margin_rad += options_.collapse_angle_margin_rad;
        return projected_error_px(refiner_.mesh(), node, view_, criterion);
    }

    /// The node of the last collapse in a slot, and its frame.
    struct LastCollapse {
        std::uint32_t node = none;
        std::uint32_t frame = 0;
    };

    void collect_candidates();
    void consider_split(std::uint32_t node);
    void split_worst();
    void start_moves();
    void reverse_moves();
    void collapse_smallest();
    bool move_and_collapse(std::uint32_t node);
    bool rests_after_split(std::uint32_t node) const;
    bool rests_after_collapse(std::uint32_t node) const;
    bool needs_resting(std::uint32_t node);

    ViewRefinerOptions options_;
    std::shared_ptr<const MeshTextures> textures_;
    SelectiveRefiner refiner_;
    Geomorphs moves_;
    RefineView view_;
    bool has_view_ = false;
    bool settled_ = false;
    bool waiting_ = false; ///< Something has to be done in a later frame.
    std::uint32_t frame_ = 0;
    std::vector<Candidate> splits_; ///< A heap with the largest error on top.
    std::vector<Candidate> collapses_;
    std::vector<std::uint32_t> turning_; ///< Scratch memory of reverse_moves: slots.
    std::vector<std::uint32_t> forced_;  ///< Scratch memory of needs_resting.
    /// For each slot the frame in which a split put its node there.
    std::vector<std::uint32_t> split_frames_;
    std::vector<LastCollapse> collapsed_; ///< One for each slot.
};

} // namespace octant::visuals::refine
