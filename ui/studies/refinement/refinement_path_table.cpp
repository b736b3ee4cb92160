#include "ui/studies/refinement/model_bounds.h"
#include "ui/studies/refinement/refinement_tables.h"
#include "visuals/refine/refine_criterion.h"
#include "visuals/refine/view_refiner.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace octant::ui::studies::refinement {

namespace {

namespace refine = visuals::refine;

refine::RefineView view_at(const BoundingSphere& model, double turn_rad, double nearness) {
    const double away_m = model.reach_m * (2.4 - 1.2 * nearness);
    const glm::dvec3 out = glm::normalize(glm::dvec3(std::cos(turn_rad), std::sin(turn_rad), 0.4));
    return refine::picture_view(
        model.centre_m + away_m * out, model.centre_m, {0.0, 0.0, 1.0}, 50.0 * std::numbers::pi / 180.0, 1280.0, 720.0);
}

/// Once around in `frames` frames, and twice near.
refine::RefineView path_view(const BoundingSphere& model, int frame, int frames) {
    const double done = 2.0 * std::numbers::pi * frame / frames;
    return view_at(model, done, 0.5 - 0.5 * std::cos(2.0 * done));
}

glm::dvec2 pixel(const refine::RefineView& view, const glm::dvec3& point_m) {
    const glm::dvec3 right = glm::normalize(glm::cross(view.forward, glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 seen_m = point_m - view.eye_m;
    const double depth_m = std::max(glm::dot(view.forward, seen_m), view.near_m);
    return glm::dvec2(glm::dot(right, seen_m), glm::dot(glm::cross(right, view.forward), seen_m)) *
           (view.focal_px / depth_m);
}

/// Which inner nodes are split, frame by frame.
class SplitWatch {
public:
    explicit SplitWatch(const refine::SelectiveRefiner& front)
        : leaves_(static_cast<std::uint32_t>(front.mesh().leaf_count())), nodes_(front.mesh().node_count() - leaves_) {
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) { nodes_[i].is_split = front.is_split(leaves_ + i); }
    }

    void view_towards(const refine::ViewRefiner& refiner, int frame) {
        constexpr int soon_frames = 10;
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            Node& node = nodes_[i];
            const bool is_split = refiner.front().is_split(leaves_ + i);
            split_ += is_split ? 1U : 0U;
            kept_ += is_split && refiner.keeps_split(leaves_ + i) ? 1U : 0U;
            if (is_split != node.is_split) {
                undone_soon_ += node.changed > 0 && frame - node.changed <= soon_frames ? 1U : 0U;
                node = {is_split, frame};
            }
        }
    }

    /// Nodes split and merged, or merged and split, within 10 frames.
    std::size_t undone_soon() const { return undone_soon_; }

    /// Split ones over those that the criterion kept split, all frames.
    double split_to_kept_ratio() const {
        return static_cast<double>(split_) / static_cast<double>(std::max<std::size_t>(kept_, 1));
    }

private:
    struct Node {
        bool is_split = false;
        int changed = 0; ///< frame; 0 = never
    };

    std::uint32_t leaves_;
    std::vector<Node> nodes_;
    std::size_t undone_soon_ = 0;
    std::size_t split_ = 0;
    std::size_t kept_ = 0;
};

struct PathRun {
    double operations_mean = 0.0;
    std::size_t operations_max = 0;
    double active_mean = 0.0;
    double largest_step_px = 0.0;
    double ms_mean = 0.0;        ///< processor time of an update
    std::size_t undone_soon = 0; ///< see SplitWatch
    double split_to_kept_ratio = 0.0;
};

/// Where each original vertex is drawn.
void drawn_places(const refine::SelectiveRefiner& front, std::vector<glm::vec3>& places_m) {
    places_m.resize(front.mesh().leaf_count());
    for (std::uint32_t leaf = 0; leaf < places_m.size(); ++leaf) {
        places_m[leaf] = front.vertices()[front.slot(front.active_ancestor(leaf))].position_m;
    }
}

PathRun run_path(const RefinedModel& model, int frames) {
    refine::ViewRefiner refiner(model);
    const BoundingSphere place = bounding_sphere(*model);
    const refine::RefineView first = path_view(place, 0, frames);
    for (int i = 0; i < 1000 && !refiner.update(first).settled; ++i) {}
    PathRun run;
    std::vector<glm::vec3> before_m;
    std::vector<glm::vec3> after_m;
    drawn_places(refiner.front(), before_m);
    SplitWatch watch(refiner.front());
    for (int frame = 1; frame <= frames; ++frame) {
        const refine::RefineView view = path_view(place, frame, frames);
        const double start_s = process_cpu_time_s();
        const refine::RefinedFrame done = refiner.update(view);
        run.ms_mean += 1000.0 * (process_cpu_time_s() - start_s) / frames;
        watch.view_towards(refiner, frame);
        const std::size_t operations = done.splits + done.collapses;
        run.operations_mean += static_cast<double>(operations) / frames;
        run.operations_max = std::max(run.operations_max, operations);
        run.active_mean += static_cast<double>(refiner.front().active_count()) / frames;
        drawn_places(refiner.front(), after_m);
        for (std::size_t leaf = 0; leaf < after_m.size(); ++leaf) {
            if (after_m[leaf] != before_m[leaf]) {
                const glm::dvec3& origin_m = model->parts().origin_m;
                run.largest_step_px =
                    std::max(run.largest_step_px, glm::distance(pixel(view, glm::dvec3(before_m[leaf]) + origin_m),
                                                      pixel(view, glm::dvec3(after_m[leaf]) + origin_m)));
            }
        }
        std::swap(before_m, after_m);
    }
    run.undone_soon = watch.undone_soon();
    run.split_to_kept_ratio = watch.split_to_kept_ratio();
    return run;
}

struct RequestedSums {
    std::size_t wanted = 0;
    std::size_t bare = 0;     ///< splits of a fresh front without repair
    std::size_t repaired = 0; ///< splits of a fresh front with repair
};

/// What views along the path want alone, and what is split for it.
RequestedSums requested_along(const RefinedModel& model, int frames) {
    RequestedSums sums;
    const BoundingSphere place = bounding_sphere(*model);
    for (int frame = 0; frame < frames; frame += std::max(1, frames / 20)) {
        const refine::RefineView view = path_view(place, frame, frames);
        refine::SelectiveRefiner bare(model, {.repair = false});
        sums.wanted += refine::refine_for_view(bare, view, 1.0);
        sums.bare += bare.counts().splits;
        refine::SelectiveRefiner repaired(model);
        refine::refine_for_view(repaired, view, 1.0);
        repaired.repair();
        sums.repaired += repaired.counts().splits;
    }
    return sums;
}

} // namespace

report::HtmlTable refinement_path_table(std::span<const RefinedModel> models, int frames) {
    report::HtmlTable table;
    table.title = fmt::format("Around each model in {} frames, errors of 1 px", frames);
    table.header = {"model", "operations a frame, mean", "most", "active vertices, mean",
        "largest step of a vertex, px", "ms a frame", "split and merged within 10 frames", "split / kept",
        "split / wanted", "with repair"};
    for (const RefinedModel& model : models) {
        const PathRun run = run_path(model, frames);
        const RequestedSums sums = requested_along(model, frames);
        const auto wanted = static_cast<double>(std::max<std::size_t>(sums.wanted, 1));
        table.rows.push_back({model->parts().name, fmt::format("{:.1f}", run.operations_mean),
            fmt::format("{}", run.operations_max), fmt::format("{:.0f}", run.active_mean),
            fmt::format("{:.3f}", run.largest_step_px), fmt::format("{:.3f}", run.ms_mean),
            fmt::format("{}", run.undone_soon), fmt::format("{:.4f}", run.split_to_kept_ratio),
            fmt::format("{:.4f}", static_cast<double>(sums.bare) / wanted),
            fmt::format("{:.4f}", static_cast<double>(sums.repaired) / wanted)});
    }
    table.note = "1280x720, 50 degrees. A step: of any original vertex, as drawn, between two "
                 "frames seen from the second one's eye. Split and merged: nodes, either way "
                 "around. Split / kept: of all frames, against the nodes that the criterion for "
                 "merging keeps; the others are on their way to a merge or rest. Split / wanted: "
                 "fresh fronts at 20 places of the path against the nodes that the criterion "
                 "wants split.";
    return table;
}

} // namespace octant::ui::studies::refinement
