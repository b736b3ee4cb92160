#include "ui/studies/refinement/study_refinement.h"

#include "models/procedural/procedural_terrain.h"
#include "models/simplify/simplify.h"
#include "sim/base/stopwatch.h"
#include "ui/base/progress.h"
#include "ui/studies/shading_pictures.h"
#include "ui/studies/study.h"
#include "ui/world/mesh_loader.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/classic_split_rules.h"
#include "visuals/refine/progressive_mesh.h"
#include "visuals/refine/refine_criterion.h"
#include "visuals/refine/selective_refiner.h"
#include "visuals/refine/view_refiner.h"
#include "visuals/shading/vertex_normals.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <utility>

namespace octant::ui::studies::refinement {

namespace {

namespace refine = visuals::refine;
namespace shading = visuals::shading;

using RefinedModel = std::shared_ptr<const visuals::refine::ProgressiveMesh>;

// Table 1: forced splits.

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

using RequiredSplits = std::array<refine::RequiredSplit, rules.size()>;

void measure(const RefinedModel& model, const RequiredSplits& required, const Request& request, ForcedSums& sums) {
    for (std::size_t rule = 0; rule < rules.size(); ++rule) {
        refine::SelectiveRefiner front(model, {.required_split = required[rule], .repair = false});
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

std::vector<report::Cell> row_of(const std::string& model, const std::string& region, const ForcedSums& sums) {
    return {{"model", model}, {"region", region}, {"requested", sums.requested},
        {"selective", "{:.2f}", percent(sums.forced[0], sums.requested)},
        {"Hoppe 1997", "{:.1f}", percent(sums.forced[1], sums.requested)},
        {"Xia & Varshney 1996", "{:.1f}", percent(sums.forced[2], sums.requested)},
        {"faces turned over", "{:.2f}", percent(sums.turned, sums.faces)}, {"after repair (faces)", sums.turned_after},
        {"repair", "{:.1f}", percent(sums.repairs, sums.requested)}};
}

/// Splits that each rule forces, percent of those requested; faces turned over without repair and what repair costs.
/// One base vertex after another, and spheres of shares of the diagonal.
report::ResultTable forced_splits_table(std::span<const RefinedModel> models) {
    report::ResultTable table{"Splits beyond those requested, percent"};
    for (const RefinedModel& model : models) {
        RequiredSplits required;
        std::ranges::transform(
            rules, required.begin(), [&](refine::SplitRule rule) { return refine::required_split_of(rule, *model); });
        ForcedSums below;
        for (const std::uint32_t root : model->roots()) {
            if (!model->is_leaf(root)) {
                measure(
                    model, required,
                    [&](refine::SelectiveRefiner& front) { return refine::refine_subtree(front, root); }, below);
            }
        }
        table.add(row_of(model->parts().name, "one base vertex", below));
        const double diagonal_m = 2.0 * model->half_diagonal_m();
        for (const int share : {2, 5, 10, 20}) {
            ForcedSums sums;
            std::mt19937 numbers(7);
            for (int sphere = 0; sphere < 12; ++sphere) {
                const auto leaf = static_cast<std::uint32_t>(numbers() % model->leaf_count());
                const refine::Sphere region{
                    glm::dvec3(model->position_m(leaf)) + model->parts().origin_m, 0.01 * share * diagonal_m};
                measure(
                    model, required,
                    [&](refine::SelectiveRefiner& front) {
                        return refine::refine_regions(front, std::span(&region, 1));
                    },
                    sums);
            }
            table.add(row_of(model->parts().name, fmt::format("sphere of {} %", share), sums));
        }
    }
    table.note = "One base vertex: each in turn to full resolution, on a fresh front; sums. Spheres: "
                 "radius as a share of the diagonal, 12 places by chance. The three rules over the "
                 "same hierarchy, without repair. Turned over: more than 90 degrees off the "
                 "original face, percent of the active faces; repair: further splits, percent.";
    return table;
}

/// Once around in `frames` frames, and twice near.
refine::RefineView path_view(const refine::ProgressiveMesh& model, int frame, int frames) {
    const double turn_rad = 2.0 * std::numbers::pi * frame / frames;
    const double nearness = 0.5 - 0.5 * std::cos(2.0 * turn_rad);
    const double away_m = model.half_diagonal_m() * (2.4 - 1.2 * nearness);
    const glm::dvec3 out = glm::normalize(glm::dvec3(std::cos(turn_rad), std::sin(turn_rad), 0.4));
    return refine::picture_view(model.middle_m() + away_m * out, model.middle_m(), {0.0, 0.0, 1.0},
        50.0 * std::numbers::pi / 180.0, 1280.0, 720.0);
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

    void add(const refine::ViewRefiner& refiner, int frame) {
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
    const refine::RefineView first = path_view(*model, 0, frames);
    for (int i = 0; i < 1000 && !refiner.update(first).settled; ++i) {}
    PathRun run;
    std::vector<glm::vec3> before_m;
    std::vector<glm::vec3> after_m;
    drawn_places(refiner.front(), before_m);
    SplitWatch watch(refiner.front());
    for (int frame = 1; frame <= frames; ++frame) {
        const refine::RefineView view = path_view(*model, frame, frames);
        const double start_s = process_cpu_s();
        const refine::RefinedFrame done = refiner.update(view);
        run.ms_mean += 1000.0 * (process_cpu_s() - start_s) / frames;
        watch.add(refiner, frame);
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
    for (int frame = 0; frame < frames; frame += std::max(1, frames / 20)) {
        const refine::RefineView view = path_view(*model, frame, frames);
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

/// A view that goes around each model and nearer and back: operations a frame, steps of vertices.
report::ResultTable refinement_path_table(std::span<const RefinedModel> models, int frames) {
    report::ResultTable table{fmt::format("Around each model in {} frames, errors of 1 px", frames)};
    for (const RefinedModel& model : models) {
        const PathRun run = run_path(model, frames);
        const RequestedSums sums = requested_along(model, frames);
        const auto wanted = static_cast<double>(std::max<std::size_t>(sums.wanted, 1));
        table.add({{"model", model->parts().name}, {"operations a frame, mean", "{:.1f}", run.operations_mean},
            {"most", run.operations_max}, {"active vertices, mean", "{:.0f}", run.active_mean},
            {"largest step of a vertex, px", "{:.3f}", run.largest_step_px}, {"ms a frame", "{:.3f}", run.ms_mean},
            {"split and merged within 10 frames", run.undone_soon}, {"split / kept", "{:.4f}", run.split_to_kept_ratio},
            {"split / wanted", "{:.4f}", static_cast<double>(sums.bare) / wanted},
            {"with repair", "{:.4f}", static_cast<double>(sums.repaired) / wanted}});
    }
    table.note = "1280x720, 50 degrees. A step: of any original vertex, as drawn, between two "
                 "frames seen from the second one's eye. Split and merged: nodes, either way "
                 "around. Split / kept: of all frames, against the nodes that the criterion for "
                 "merging keeps; the others are on their way to a merge or rest. Split / wanted: "
                 "fresh fronts at 20 places of the path against the nodes that the criterion "
                 "wants split.";
    return table;
}

struct Rates {
    double splits_mps = 0.0;       ///< millions a second, in one call
    double coarse_first_mps = 0.0; ///< one by one
    double any_order_mps = 0.0;    ///< one by one in an order by chance
    double collapses_mps = 0.0;    ///< finest first
};

/// Processor time of a call.
template <class Work>
double seconds_of(const Work& work) {
    const double start_s = process_cpu_s();
    work();
    return process_cpu_s() - start_s;
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

/// Operations a second on one core and memory.
report::ResultTable refinement_speed_table(std::span<const RefinedModel> models) {
    report::ResultTable table{"Speed on one core and memory"};
    for (const RefinedModel& model : models) {
        const Rates rates = rates_of(model);
        refine::SelectiveRefiner front(model, {.repair = false});
        front.split_all(model->coarsest_first());
        const auto vertices = static_cast<double>(model->leaf_count());
        const double index_bytes = static_cast<double>(front.indices().size_bytes()) / vertices;
        table.add({{"model", model->parts().name}, {"original vertices", model->leaf_count()},
            {"splits, M/s", "{:.2f}", rates.splits_mps}, {"coarsest first, M/s", "{:.2f}", rates.coarse_first_mps},
            {"any order, M/s", "{:.2f}", rates.any_order_mps}, {"collapses, M/s", "{:.2f}", rates.collapses_mps},
            {"hierarchy, bytes a vertex", "{:.1f}", static_cast<double>(model->bytes()) / vertices},
            {"front, bytes an active vertex", "{:.1f}", static_cast<double>(front.bytes()) / vertices},
            {"of them its index list", "{:.1f}", index_bytes}, {"drawn vertex, bytes", sizeof(refine::RefinedVertex)}});
    }
    table.note = "Processor time, everything split from the base mesh for a second, drawn vertices and "
                 "index list kept up to date, without repair. Splits: handed over in one call, which takes "
                 "an order of its own; the others one by one: coarsest first as the simplification went "
                 "backwards, or by chance, ancestors first where they are missing. The front at full "
                 "resolution with its index list; that and the drawn vertices go to the graphics card.";
    return table;
}

// Pictures.

constexpr int size_px = 480;
constexpr auto background = std::byte{255};

/// Axes of ShadingPictures: x forward, y right, z down.
models::TriangleMesh in_body_axes(models::TriangleMesh mesh, bool y_up) {
    for (glm::dvec3& point_m : mesh.vertices_m) {
        point_m = y_up ? glm::dvec3(point_m.x, point_m.z, -point_m.y) : glm::dvec3(point_m.x, -point_m.y, -point_m.z);
    }
    mesh.normals.clear();
    mesh.corner_normals.clear();
    mesh.materials.clear();
    mesh.triangle_materials.clear();
    if (mesh.colours.empty()) { mesh.colours.assign(mesh.vertices_m.size(), glm::vec3(0.6F)); }
    return mesh;
}

/// Flat faces from the right, a little from the front and above. Light is worked out for red, green and blue in turn.
report::Picture picture_of(const models::TriangleMesh& original, bool y_up) {
    const models::TriangleMesh mesh = in_body_axes(original, y_up);
    shading::ShadingLight light;
    light.to_light = glm::normalize(glm::vec3(0.5F, 0.6F, -0.7F));
    light.ambient = 0.35F;
    light.diffuse = 0.65F;
    light.specular = 0.0F;
    const std::vector<glm::vec3> normals = shading::corner_normals(mesh);
    report::Picture picture{size_px, size_px, 3, {}};
    picture.bytes.assign(std::size_t{3} * size_px * size_px, background);
    for (int part = 0; part < 3; ++part) {
        models::TriangleMesh tinted = mesh;
        for (glm::vec3& colour : tinted.colours) { colour = glm::vec3(colour[part], 0.0F, 0.0F); }
        const shading::ShadedPolygons polygons = shading::shaded_polygons(tinted, normals);
        const glm::dvec3 eye_m = glm::dvec3(polygons.centre_m) + 3.0 * static_cast<double>(polygons.radius_m) *
                                                                     glm::normalize(glm::dvec3(0.35, 1.0, -0.3));
        const ShadingPictures pictures(polygons, light, eye_m, size_px);
        const LightPicture seen = pictures.hybrid(std::vector<std::uint8_t>(polygons.size(), 0));
        for (std::size_t at = 0; at < seen.light.size(); ++at) {
            if (pictures.covered()[at] != 0) {
                const float shown = glm::clamp(seen.light[at], 0.0F, 1.0F);
                picture.bytes[3 * at + static_cast<std::size_t>(part)] =
                    static_cast<std::byte>(std::lround(255.0F * shown));
            }
        }
    }
    return picture;
}

/// About the original vertex that lies nearest to three quarters of the way to the front and below the middle.
refine::Sphere chest_of(const models::TriangleMesh& original, bool y_up) {
    const models::BoundingBox bounds = models::bounds_of(original);
    const glm::dvec3 share = y_up ? glm::dvec3(0.72, 0.42, 0.8) : glm::dvec3(0.72, 0.2, 0.42);
    const glm::dvec3 wanted_m = glm::mix(bounds.min_m, bounds.max_m, share);
    const auto nearest = std::ranges::min_element(
        original.vertices_m, {}, [&](const auto& at_m) { return glm::distance(at_m, wanted_m); });
    return {*nearest, 0.12 * models::diagonal_m(original)};
}

/// The paper's figure of what refinement means: a model, its base mesh, the parts of the model that the base mesh's
/// vertices stand for, and the base mesh with one part (a cow's chest: front, low) refined all the way. `y_up`: else z
/// is. The model is seen from its right, its front is at +x. Throws Error.
void add_pictures(Study& study, const RefinedModel& model, bool y_up) {
    refine::SelectiveRefiner front(model);
    const auto add = [&](const char* name, const models::TriangleMesh& mesh, const std::string& what) {
        study.add(fmt::format("refinement-{}.png", name), picture_of(mesh, y_up).view(),
            fmt::format("{}: {}", model->parts().name, what));
    };
    const models::TriangleMesh original = refine::partition_mesh(front, refine::ColourBy::Nothing);
    add("original", original, fmt::format("{} vertices", model->leaf_count()));
    models::TriangleMesh base = refine::active_mesh(front).mesh;
    base.colours.clear();
    add("base", base, fmt::format("its base mesh of {} vertices", model->roots().size()));
    add("partition", refine::partition_mesh(front), "the parts that these stand for");
    const refine::Sphere chest = chest_of(original, y_up);
    refine::refine_regions(front, std::span(&chest, 1));
    front.repair();
    add("region", refine::coloured_mesh(refine::active_mesh(front), refine::ColourBy::Level),
        fmt::format("one part refined, {} vertices (blue: original ones)", front.active_count()));
}

/// Two triangles between four samples each.
models::TriangleMesh mesh_of(const models::heights::HeightField& field) {
    models::TriangleMesh mesh;
    mesh.name = field.name;
    const auto columns = static_cast<std::uint32_t>(field.columns());
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            mesh.vertices_m.push_back(field.sample_m(column, row));
            if (row + 1 < field.rows() && column + 1 < field.columns()) {
                const auto at = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
                mesh.triangles.push_back({at, at + 1, at + columns + 1});
                mesh.triangles.push_back({at, at + columns + 1, at + columns});
            }
        }
    }
    return mesh;
}

RefinedModel made_ground(int base) {
    models::procedural::ProceduralTerrainOptions made;
    made.size = 129;
    models::TriangleMesh mesh = mesh_of(models::procedural::procedural_hills(made));
    mesh.name = "hills";
    models::simplify::SimplifyOptions options;
    options.length_share = 0.03;
    options.goal.vertices = static_cast<std::size_t>(base);
    return std::make_shared<const refine::ProgressiveMesh>(models::simplify::fast_sequence(std::move(mesh), options));
}

std::vector<RefinedModel> read_models(const RefinementStudyOptions& options) {
    std::vector<RefinedModel> models;
    for (const std::string& file : options.meshes) {
        world::RefineMeshOptions input;
        input.file = file;
        input.base = static_cast<std::size_t>(options.base);
        input.quiet = options.quiet;
        models.push_back(world::load_refine_mesh(input).mesh);
    }
    if (models.empty()) { models.push_back(made_ground(options.base)); }
    return models;
}

} // namespace

void study_refinement(const RefinementStudyOptions& options) {
    const std::vector<RefinedModel> models = read_models(options);
    Study study(options);
    const auto add = [&](const char* file, report::ResultTable table) {
        study.add(file, std::move(table));
        base::print_note(options.quiet, fmt::format("done: {}", file));
    };
    add("forced-splits", forced_splits_table(models));
    add("refinement-path", refinement_path_table(models, options.frames));
    add("refinement-speed", refinement_speed_table(models));
    add_pictures(study, models.back(), !options.meshes.empty()); // The made ground has z up, mesh files y.
    study.finish("refinement");
}

} // namespace octant::ui::studies::refinement
