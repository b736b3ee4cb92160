#include "ui/refinement_place.h"
#include "ui/refinement_tables.h"
#include "visuals/refine/refine_region.h"
#include "visuals/refine/view_refiner.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace octant::ui {

namespace {

namespace refine = visuals::refine;

refine::RefineView view_at(const Around& model, double turn_rad, double nearness) {
    const double away_m = model.reach_m * (2.4 - 1.2 * nearness);
    const glm::dvec3 out = glm::normalize(glm::dvec3(std::cos(turn_rad), std::sin(turn_rad), 0.4));
    return refine::picture_view(
        model.centre_m + away_m * out,
        model.centre_m,
        {0.0, 0.0, 1.0},
        50.0 * std::numbers::pi / 180.0,
        1280.0,
        720.0);
}

/// Once around in `frames` frames, and twice near.
refine::RefineView path_view(const Around& model, int frame, int frames) {
    const double done = 2.0 * std::numbers::pi * frame / frames;
    return view_at(model, done, 0.5 - 0.5 * std::cos(2.0 * done));
}

glm::dvec2 pixel(const refine::RefineView& view, const glm::dvec3& point_m) {
    const glm::dvec3 right = glm::normalize(glm::cross(view.ahead, glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 seen_m = point_m - view.eye_m;
    const double depth_m = std::max(glm::dot(view.ahead, seen_m), view.near_m);
    return glm::dvec2(glm::dot(right, seen_m), glm::dot(glm::cross(right, view.ahead), seen_m)) *
           (view.focal_px / depth_m);
}

struct PathRun {
    double operations_mean = 0.0;
    std::size_t operations_most = 0;
    double active_mean = 0.0;
    double largest_step_px = 0.0;
    double ms_mean = 0.0; ///< processor time of an update
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
    const Around place = around(*model);
    const refine::RefineView first = path_view(place, 0, frames);
    for (int i = 0; i < 1000 && !refiner.update(first).settled; ++i) {
    }
    PathRun run;
    std::vector<glm::vec3> before_m;
    std::vector<glm::vec3> after_m;
    drawn_places(refiner.front(), before_m);
    for (int frame = 1; frame <= frames; ++frame) {
        const refine::RefineView view = path_view(place, frame, frames);
        const double start_s = cpu_s();
        const refine::RefinedFrame done = refiner.update(view);
        run.ms_mean += 1000.0 * (cpu_s() - start_s) / frames;
        const std::size_t operations = done.splits + done.collapses;
        run.operations_mean += static_cast<double>(operations) / frames;
        run.operations_most = std::max(run.operations_most, operations);
        run.active_mean += static_cast<double>(refiner.front().active_count()) / frames;
        drawn_places(refiner.front(), after_m);
        for (std::size_t leaf = 0; leaf < after_m.size(); ++leaf) {
            if (after_m[leaf] != before_m[leaf]) {
                const glm::dvec3& origin_m = model->parts().origin_m;
                run.largest_step_px = std::max(
                    run.largest_step_px,
                    glm::distance(
                        pixel(view, glm::dvec3(before_m[leaf]) + origin_m),
                        pixel(view, glm::dvec3(after_m[leaf]) + origin_m)));
            }
        }
        std::swap(before_m, after_m);
    }
    return run;
}

struct WantedSums {
    std::size_t wanted = 0;
    std::size_t bare = 0;     ///< splits of a fresh front without repair
    std::size_t repaired = 0; ///< with
};

/// What views along the path want alone, and what is split for it.
WantedSums wanted_along(const RefinedModel& model, int frames) {
    WantedSums sums;
    const Around place = around(*model);
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
    table.header = {
        "model",
        "operations a frame, mean",
        "most",
        "active vertices, mean",
        "largest step of a vertex, px",
        "ms a frame",
        "split / wanted",
        "with repair"};
    for (const RefinedModel& model : models) {
        const PathRun run = run_path(model, frames);
        const WantedSums sums = wanted_along(model, frames);
        const auto wanted = static_cast<double>(std::max<std::size_t>(sums.wanted, 1));
        table.rows.push_back(
            {model->parts().name,
             fmt::format("{:.1f}", run.operations_mean),
             fmt::format("{}", run.operations_most),
             fmt::format("{:.0f}", run.active_mean),
             fmt::format("{:.3f}", run.largest_step_px),
             fmt::format("{:.3f}", run.ms_mean),
             fmt::format("{:.4f}", static_cast<double>(sums.bare) / wanted),
             fmt::format("{:.4f}", static_cast<double>(sums.repaired) / wanted)});
    }
    table.note = "1280x720, 50 degrees. A step: of any original vertex, as drawn, between two "
                 "frames seen from the second one's eye. Split / wanted: fresh fronts at 20 places "
                 "of the path against the nodes that the criterion wants split.";
    return table;
}

} // namespace octant::ui
