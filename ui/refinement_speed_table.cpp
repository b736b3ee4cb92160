#include "ui/refinement_place.h"
#include "ui/refinement_tables.h"
#include "visuals/refine/selective_refiner.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <random>

namespace octant::ui {

namespace {

namespace refine = visuals::refine;

struct Rates {
    double splits_mps = 0.0;  ///< millions a second, coarsest first, in one call
    double subtree_mps = 0.0; ///< by subtree, in one call
    double collapses_mps = 0.0;
    double any_order_mps = 0.0; ///< one by one in an order by chance
};

std::vector<std::uint32_t> inner_nodes(const refine::ProgressiveMesh& mesh) {
    std::vector<std::uint32_t> nodes(mesh.node_count() - mesh.leaf_count());
    std::iota(nodes.begin(), nodes.end(), static_cast<std::uint32_t>(mesh.leaf_count()));
    return nodes;
}

/// A node's subtree before the next node.
std::vector<std::uint32_t> inner_by_subtree(const refine::ProgressiveMesh& mesh) {
    std::vector<std::uint32_t> nodes;
    std::vector<std::uint32_t> open(mesh.roots().begin(), mesh.roots().end());
    while (!open.empty()) {
        const std::uint32_t node = open.back();
        open.pop_back();
        if (!mesh.is_leaf(node)) {
            nodes.push_back(node);
            open.push_back(mesh.split_of(node).second);
            open.push_back(mesh.split_of(node).first);
        }
    }
    return nodes;
}

/// Processor time of a call.
template <class Work>
double seconds_of(const Work& work) {
    const double start_s = cpu_s();
    work();
    return cpu_s() - start_s;
}

Rates rates_of(const RefinedModel& model) {
    constexpr double least_s = 1.0;
    refine::SelectiveRefiner front(model, {.repair = false});
    const std::vector<std::uint32_t> nodes = inner_nodes(*model);
    const std::vector<std::uint32_t> coarse_first(nodes.rbegin(), nodes.rend());
    const std::vector<std::uint32_t> by_subtree = inner_by_subtree(*model);
    std::vector<std::uint32_t> any_order = nodes;
    std::mt19937 numbers(1);
    std::shuffle(any_order.begin(), any_order.end(), numbers);
    double split_s = 0.0;
    double subtree_s = 0.0;
    double collapse_s = 0.0;
    double any_s = 0.0;
    std::size_t rounds = 0;
    for (; split_s < least_s; ++rounds) {
        front.restart();
        subtree_s += seconds_of([&] { front.split_all(by_subtree); });
        front.restart();
        any_s += seconds_of([&] {
            for (const std::uint32_t node : any_order) {
                front.split(node);
            }
        });
        front.restart();
        split_s += seconds_of([&] { front.split_all(coarse_first); });
        collapse_s += seconds_of([&] {
            for (const std::uint32_t node : nodes) {
                front.collapse(node);
            }
        });
    }
    const double millions = 1e-6 * static_cast<double>(rounds) * static_cast<double>(nodes.size());
    return {millions / split_s, millions / subtree_s, millions / collapse_s, millions / any_s};
}

} // namespace

report::HtmlTable refinement_speed_table(std::span<const RefinedModel> models) {
    report::HtmlTable table;
    table.title = "Speed on one core and memory";
    table.header = {
        "model",
        "original vertices",
        "splits, M/s",
        "splits by subtree, M/s",
        "splits in any order, M/s",
        "collapses, M/s",
        "hierarchy, bytes a vertex",
        "front, bytes an active vertex",
        "its index list, bytes",
        "drawn vertex, bytes"};
    for (const RefinedModel& model : models) {
        const Rates rates = rates_of(model);
        refine::SelectiveRefiner front(model, {.repair = false});
        for (std::size_t node = model->node_count(); node-- > model->leaf_count();) {
            front.split(static_cast<std::uint32_t>(node));
        }
        const auto vertices = static_cast<double>(model->leaf_count());
        const double index_bytes = static_cast<double>(front.indices().size_bytes()) / vertices;
        table.rows.push_back(
            {model->parts().name,
             fmt::format("{}", model->leaf_count()),
             fmt::format("{:.2f}", rates.splits_mps),
             fmt::format("{:.2f}", rates.subtree_mps),
             fmt::format("{:.2f}", rates.any_order_mps),
             fmt::format("{:.2f}", rates.collapses_mps),
             fmt::format("{:.1f}", static_cast<double>(model->bytes()) / vertices),
             fmt::format("{:.1f}", static_cast<double>(front.bytes()) / vertices - index_bytes),
             fmt::format("{:.1f}", index_bytes),
             fmt::format("{}", sizeof(refine::RefinedVertex))});
    }
    table.note =
        "Processor time, everything split from the base mesh for a second, drawn vertices and "
        "index list kept up to date, without repair. Splits: coarsest first, or a node's subtree "
        "before the next node, each in one call; any order: one by one by chance, ancestors first "
        "where they are missing. The front at full resolution; index list and drawn vertices are "
        "what goes to the graphics card.";
    return table;
}

} // namespace octant::ui
