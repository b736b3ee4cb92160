#include "ui/studies/refinement/model_bounds.h"
#include "ui/studies/refinement/refinement_tables.h"
#include "visuals/refine/selective_refiner.h"

#include <algorithm>
#include <fmt/format.h>
#include <random>

namespace octant::ui::studies::refinement {

namespace {

namespace refine = visuals::refine;

struct Rates {
    double splits_mps = 0.0;       ///< millions a second, in one call
    double coarse_first_mps = 0.0; ///< one by one
    double any_order_mps = 0.0;    ///< one by one in an order by chance
    double collapses_mps = 0.0;    ///< finest first
};

/// Processor time of a call.
template <class Work>
double seconds_of(const Work& work) {
    const double start_s = process_cpu_time_s();
    work();
    return process_cpu_time_s() - start_s;
}

Rates rates_of(const RefinedModel& model) {
    constexpr double min_s = 1.0;
    refine::SelectiveRefiner front(model, {.repair = false});
    const std::vector<std::uint32_t> nodes = model->coarsest_first();
    std::vector<std::uint32_t> any_order = nodes;
    std::mt19937 numbers(1);
    std::shuffle(any_order.begin(), any_order.end(), numbers);
    const auto split_each = [&](const std::vector<std::uint32_t>& order) {
        for (const std::uint32_t node : order) { front.split(node); }
    };
    double split_s = 0.0;
    double coarse_s = 0.0;
    double any_s = 0.0;
    double collapse_s = 0.0;
    std::size_t rounds = 0;
    for (; split_s < min_s; ++rounds) {
        front.restart();
        split_s += seconds_of([&] { front.split_all(nodes); });
        front.restart();
        any_s += seconds_of([&] { split_each(any_order); });
        front.restart();
        coarse_s += seconds_of([&] { split_each(nodes); });
        collapse_s += seconds_of([&] {
            for (std::size_t at = nodes.size(); at-- > 0;) { front.collapse(nodes[at]); }
        });
    }
    const double millions = 1e-6 * static_cast<double>(rounds) * static_cast<double>(nodes.size());
    return {millions / split_s, millions / coarse_s, millions / any_s, millions / collapse_s};
}

} // namespace

report::HtmlTable refinement_speed_table(std::span<const RefinedModel> models) {
    report::HtmlTable table;
    table.title = "Speed on one core and memory";
    table.header = {"model", "original vertices", "splits, M/s", "coarsest first, M/s", "any order, M/s",
        "collapses, M/s", "hierarchy, bytes a vertex", "front, bytes an active vertex", "of them its index list",
        "drawn vertex, bytes"};
    for (const RefinedModel& model : models) {
        const Rates rates = rates_of(model);
        refine::SelectiveRefiner front(model, {.repair = false});
        front.split_all(model->coarsest_first());
        const auto vertices = static_cast<double>(model->leaf_count());
        const double index_bytes = static_cast<double>(front.indices().size_bytes()) / vertices;
        table.rows.push_back({model->parts().name, fmt::format("{}", model->leaf_count()),
            fmt::format("{:.2f}", rates.splits_mps), fmt::format("{:.2f}", rates.coarse_first_mps),
            fmt::format("{:.2f}", rates.any_order_mps), fmt::format("{:.2f}", rates.collapses_mps),
            fmt::format("{:.1f}", static_cast<double>(model->bytes()) / vertices),
            fmt::format("{:.1f}", static_cast<double>(front.bytes()) / vertices), fmt::format("{:.1f}", index_bytes),
            fmt::format("{}", sizeof(refine::RefinedVertex))});
    }
    table.note = "Processor time, everything split from the base mesh for a second, drawn vertices and "
                 "index list kept up to date, without repair. Splits: handed over in one call, which takes "
                 "an order of its own; the others one by one: coarsest first as the simplification went "
                 "backwards, or by chance, ancestors first where they are missing. The front at full "
                 "resolution with its index list; that and the drawn vertices go to the graphics card.";
    return table;
}

} // namespace octant::ui::studies::refinement
