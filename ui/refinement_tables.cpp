#include "ui/refinement_tables.h"

#include "visuals/refine/refine_region.h"
#include "visuals/refine/view_refiner.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>

namespace octant::ui {

namespace {

namespace refine = visuals::refine;

constexpr std::array rules = {
    refine::SplitRule::Selective, refine::SplitRule::Hoppe, refine::SplitRule::Xia};

/// Splits what is asked for on a fresh front; returns how many splits that is.
using Request = std::function<std::size_t(refine::SelectiveRefiner&)>;

struct ForcedSums {
    std::size_t requested = 0;
    std::array<std::size_t, 3> forced{}; ///< by rule
    std::size_t faces = 0;
    std::size_t turned = 0;       ///< without repair
    std::size_t turned_after = 0; ///< with
    std::size_t repairs = 0;
};

void measure(
    const RefinedModel& model,
    const std::shared_ptr<const refine::EarlierRules>& earlier,
    const Request& request,
    ForcedSums& sums) {
    for (std::size_t rule = 0; rule < rules.size(); ++rule) {
        refine::SelectiveRefiner front(
            model, {.rule = rules[rule], .repair = false, .earlier = earlier});
        const std::size_t requested = request(front);
        sums.forced[rule] += front.counts().splits - requested;
        if (rule == 0) {
            sums.requested += requested;
            sums.faces += front.face_count();
            sums.turned += front.turned_faces();
        }
    }
    refine::SelectiveRefiner mended(model);
    request(mended);
    sums.repairs += mended.repair();
    sums.turned_after += mended.turned_faces();
}

double percent(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::vector<std::string>
row_of(const std::string& model, std::string region, const ForcedSums& sums) {
    return {
        model,
        std::move(region),
        fmt::format("{}", sums.requested),
        fmt::format("{:.2f}", percent(sums.forced[0], sums.requested)),
        fmt::format("{:.1f}", percent(sums.forced[1], sums.requested)),
        fmt::format("{:.1f}", percent(sums.forced[2], sums.requested)),
        fmt::format("{:.2f}", percent(sums.turned, sums.faces)),
        fmt::format("{}", sums.turned_after),
        fmt::format("{:.1f}", percent(sums.repairs, sums.requested))};
}

/// Processor time of this program so far.
double cpu_s() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Rates {
    double splits_mps = 0.0; ///< millions a second
    double collapses_mps = 0.0;
    double any_order_mps = 0.0; ///< splits in an order by chance
};

std::vector<std::uint32_t> inner_nodes(const refine::ProgressiveMesh& mesh) {
    std::vector<std::uint32_t> nodes(mesh.node_count() - mesh.leaf_count());
    std::iota(nodes.begin(), nodes.end(), static_cast<std::uint32_t>(mesh.leaf_count()));
    return nodes;
}

Rates rates_of(const RefinedModel& model) {
    constexpr double least_s = 1.0;
    refine::SelectiveRefiner front(model, {.repair = false});
    const std::vector<std::uint32_t> nodes = inner_nodes(*model);
    std::vector<std::uint32_t> any_order = nodes;
    std::mt19937 numbers(1);
    std::shuffle(any_order.begin(), any_order.end(), numbers);
    double split_s = 0.0;
    double collapse_s = 0.0;
    double any_s = 0.0;
    std::size_t rounds = 0;
    for (; split_s < least_s; ++rounds) {
        double start_s = cpu_s();
        for (std::size_t i = nodes.size(); i-- > 0;) {
            front.split(nodes[i]);
        }
        split_s += cpu_s() - start_s;
        start_s = cpu_s();
        for (const std::uint32_t node : nodes) {
            front.collapse(node);
        }
        collapse_s += cpu_s() - start_s;
        start_s = cpu_s();
        for (const std::uint32_t node : any_order) {
            front.split(node);
        }
        any_s += cpu_s() - start_s;
        for (const std::uint32_t node : nodes) {
            front.collapse(node);
        }
    }
    const double millions = 1e-6 * static_cast<double>(rounds) * static_cast<double>(nodes.size());
    return {millions / split_s, millions / collapse_s, millions / any_s};
}

struct Around {
    glm::dvec3 centre_m{0.0};
    double reach_m = 0.0; ///< to the farthest vertex
};

Around around(const refine::ProgressiveMesh& mesh) {
    glm::dvec3 least_m(mesh.position_m(0));
    glm::dvec3 most_m = least_m;
    for (std::uint32_t leaf = 1; leaf < mesh.leaf_count(); ++leaf) {
        least_m = glm::min(least_m, glm::dvec3(mesh.position_m(leaf)));
        most_m = glm::max(most_m, glm::dvec3(mesh.position_m(leaf)));
    }
    return {0.5 * (least_m + most_m) + mesh.parts().origin_m, 0.5 * glm::distance(least_m, most_m)};
}

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

report::HtmlTable forced_splits_table(std::span<const RefinedModel> models) {
    report::HtmlTable table;
    table.title = "Splits beyond those requested, percent";
    table.header = {
        "model",
        "region",
        "requested",
        "selective",
        "Hoppe 1997",
        "Xia & Varshney 1996",
        "faces turned over",
        "after repair (faces)",
        "repair"};
    for (const RefinedModel& model : models) {
        const auto earlier = std::make_shared<const refine::EarlierRules>(*model);
        ForcedSums below;
        for (const std::uint32_t root : model->roots()) {
            if (!model->is_leaf(root)) {
                measure(
                    model,
                    earlier,
                    [&](refine::SelectiveRefiner& front) {
                        return refine::refine_below(front, root);
                    },
                    below);
            }
        }
        table.rows.push_back(row_of(model->parts().name, "one base vertex", below));
        const double diagonal_m = 2.0 * around(*model).reach_m;
        for (const int share : {2, 5, 10, 20}) {
            ForcedSums sums;
            std::mt19937 numbers(7);
            for (int sphere = 0; sphere < 12; ++sphere) {
                const auto leaf = static_cast<std::uint32_t>(numbers() % model->leaf_count());
                const refine::Sphere region{
                    glm::dvec3(model->position_m(leaf)) + model->parts().origin_m,
                    0.01 * share * diagonal_m};
                measure(
                    model,
                    earlier,
                    [&](refine::SelectiveRefiner& front) {
                        return refine::refine_regions(front, std::span(&region, 1));
                    },
                    sums);
            }
            table.rows.push_back(
                row_of(model->parts().name, fmt::format("sphere of {} %", share), sums));
        }
    }
    table.note =
        "One base vertex: each in turn to full resolution, on a fresh front; sums. Spheres: "
        "radius as a share of the diagonal, 12 places by chance. The three rules over the "
        "same hierarchy, without repair. Turned over: more than 90 degrees off the "
        "original face, percent of the active faces; repair: further splits, percent.";
    return table;
}

report::HtmlTable refinement_speed_table(std::span<const RefinedModel> models) {
    report::HtmlTable table;
    table.title = "Speed on one core and memory";
    table.header = {
        "model",
        "original vertices",
        "splits, M/s",
        "splits in any order, M/s",
        "collapses, M/s",
        "hierarchy, bytes a vertex",
        "front, bytes an active vertex",
        "drawn vertex, bytes"};
    for (const RefinedModel& model : models) {
        const Rates rates = rates_of(model);
        refine::SelectiveRefiner front(model, {.repair = false});
        for (std::size_t node = model->node_count(); node-- > model->leaf_count();) {
            front.split(static_cast<std::uint32_t>(node));
        }
        const auto vertices = static_cast<double>(model->leaf_count());
        table.rows.push_back(
            {model->parts().name,
             fmt::format("{}", model->leaf_count()),
             fmt::format("{:.2f}", rates.splits_mps),
             fmt::format("{:.2f}", rates.any_order_mps),
             fmt::format("{:.2f}", rates.collapses_mps),
             fmt::format("{:.1f}", static_cast<double>(model->bytes()) / vertices),
             fmt::format("{:.1f}", static_cast<double>(front.bytes()) / vertices),
             fmt::format("{}", sizeof(refine::RefinedVertex))});
    }
    table.note =
        "Processor time, everything split and collapsed again for a second, drawn vertices "
        "and index list kept up to date, without repair. In any order: an order by chance, "
        "ancestors first where they are missing. The front at full resolution, its index "
        "list included (24 bytes a vertex).";
    return table;
}

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
