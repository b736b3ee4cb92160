#include "ui/studies/refinement/refinement_tables.h"

#include "ui/studies/refinement/model_bounds.h"
#include "visuals/refine/refine_criterion.h"

#include <array>
#include <fmt/format.h>
#include <functional>
#include <random>
#include <utility>

namespace octant::ui::studies::refinement {

namespace {

namespace refine = visuals::refine;

constexpr std::array rules = {refine::SplitRule::Selective, refine::SplitRule::Hoppe, refine::SplitRule::Xia};

/// Splits what is asked for on a fresh front; returns how many splits that is.
using Request = std::function<std::size_t(refine::SelectiveRefiner&)>;

struct ForcedSums {
    std::size_t requested = 0;
    std::array<std::size_t, 3> forced{}; ///< by rule
    std::size_t faces = 0;
    std::size_t turned = 0;       ///< faces turned over without repair
    std::size_t turned_after = 0; ///< faces turned over with repair
    std::size_t repairs = 0;
};

void measure(const RefinedModel& model, const std::shared_ptr<const refine::ClassicSplitRules>& classic_rules,
    const Request& request, ForcedSums& sums) {
    for (std::size_t rule = 0; rule < rules.size(); ++rule) {
        refine::SelectiveRefiner front(model, {.rule = rules[rule], .repair = false, .classic_rules = classic_rules});
        const std::size_t requested = request(front);
        sums.forced[rule] += front.counts().splits - requested;
        if (rule == 0) {
            sums.requested += requested;
            sums.faces += front.face_count();
            sums.turned += front.flipped_faces();
        }
    }
    refine::SelectiveRefiner mended(model);
    request(mended);
    sums.repairs += mended.repair();
    sums.turned_after += mended.flipped_faces();
}

double percent(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::vector<std::string> row_of(const std::string& model, std::string region, const ForcedSums& sums) {
    return {model, std::move(region), fmt::format("{}", sums.requested),
        fmt::format("{:.2f}", percent(sums.forced[0], sums.requested)),
        fmt::format("{:.1f}", percent(sums.forced[1], sums.requested)),
        fmt::format("{:.1f}", percent(sums.forced[2], sums.requested)),
        fmt::format("{:.2f}", percent(sums.turned, sums.faces)), fmt::format("{}", sums.turned_after),
        fmt::format("{:.1f}", percent(sums.repairs, sums.requested))};
}

} // namespace

report::HtmlTable forced_splits_table(std::span<const RefinedModel> models) {
    report::HtmlTable table;
    table.title = "Splits beyond those requested, percent";
    table.header = {"model", "region", "requested", "selective", "Hoppe 1997", "Xia & Varshney 1996",
        "faces turned over", "after repair (faces)", "repair"};
    for (const RefinedModel& model : models) {
        const auto classic_rules = std::make_shared<const refine::ClassicSplitRules>(*model);
        ForcedSums below;
        for (const std::uint32_t root : model->roots()) {
            if (!model->is_leaf(root)) {
                measure(
                    model, classic_rules,
                    [&](refine::SelectiveRefiner& front) { return refine::refine_subtree(front, root); }, below);
            }
        }
        table.rows.push_back(row_of(model->parts().name, "one base vertex", below));
        const double diagonal_m = 2.0 * bounding_sphere(*model).reach_m;
        for (const int share : {2, 5, 10, 20}) {
            ForcedSums sums;
            std::mt19937 numbers(7);
            for (int sphere = 0; sphere < 12; ++sphere) {
                const auto leaf = static_cast<std::uint32_t>(numbers() % model->leaf_count());
                const refine::Sphere region{
                    glm::dvec3(model->position_m(leaf)) + model->parts().origin_m, 0.01 * share * diagonal_m};
                measure(
                    model, classic_rules,
                    [&](refine::SelectiveRefiner& front) {
                        return refine::refine_regions(front, std::span(&region, 1));
                    },
                    sums);
            }
            table.rows.push_back(row_of(model->parts().name, fmt::format("sphere of {} %", share), sums));
        }
    }
    table.note = "One base vertex: each in turn to full resolution, on a fresh front; sums. Spheres: "
                 "radius as a share of the diagonal, 12 places by chance. The three rules over the "
                 "same hierarchy, without repair. Turned over: more than 90 degrees off the "
                 "original face, percent of the active faces; repair: further splits, percent.";
    return table;
}

} // namespace octant::ui::studies::refinement
