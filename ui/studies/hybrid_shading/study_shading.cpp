#include "ui/studies/hybrid_shading/study_shading.h"

#include "models/polygons/obj_reader.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/random_generator.h"
#include "sim/base/units.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/studies/shading_pictures.h"
#include "ui/world/mesh_loader.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/view_refiner.h"
#include "visuals/shading/shading_controller.h"
#include "visuals/shading/shading_rule.h"
#include "visuals/shading/vertex_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::studies::hybrid_shading {

namespace {

namespace refine = visuals::refine;
namespace scene = visuals::scene;
namespace shading = visuals::shading;

/// The angle between the torus' quads along the inner side is more than the usual crease.
constexpr double round_crease_rad = rad_from_deg(60.0);

ShadedModel shaded_model(std::string name, const auto& model, double crease_rad = models::default_crease_rad) {
    return {std::move(name), shading::shaded_polygons(model, shading::corner_normals(model, crease_rad))};
}

/// Bunches numbers from 0 to 1 together around 0.
double concentrated(double part) { return 0.12 * part + 0.88 * part * part; }

glm::dvec3 ball_point(double polar_rad, double azimuth_rad) {
    const glm::dvec3 unit{
        std::sin(polar_rad) * std::cos(azimuth_rad), std::sin(polar_rad) * std::sin(azimuth_rad), std::cos(polar_rad)};
    const double dents =
        std::sin(4.0 * unit.x + 1.0) * std::sin(5.0 * unit.y) + 0.5 * std::sin(9.0 * unit.z + 2.0 * unit.x);
    return (1.0 + 0.12 * dents) * unit;
}

/// As fine as an eye three radii from its middle, to its side and above, needs it in a picture of 720 rows.
models::TriangleMesh refined_mesh(const std::shared_ptr<const refine::ProgressiveMesh>& hierarchy) {
    const double radius_m = hierarchy->half_diagonal_m();
    refine::RefineView view;
    view.eye_m = hierarchy->middle_m() + radius_m * glm::dvec3(1.8, 1.2, 2.1);
    view.forward = glm::normalize(hierarchy->middle_m() - view.eye_m);
    view.focal_px = 870.0;
    refine::ViewRefiner refiner(hierarchy);
    refiner.refine_fully(view);
    return refine::active_mesh(refiner.front()).mesh;
}

} // namespace

models::TriangleMesh uneven_ball(int rings, int slices) {
    assert(rings >= 2 && slices >= 3);
    models::TriangleMesh mesh;
    mesh.name = "uneven ball";
    const auto across = static_cast<std::uint32_t>(slices);
    mesh.vertices_m.push_back(ball_point(0.0, 0.0));
    for (int ring = 1; ring < rings; ++ring) {
        const double polar_rad = pi * concentrated(static_cast<double>(ring) / rings);
        for (int slice = 0; slice < slices; ++slice) {
            mesh.vertices_m.push_back(
                ball_point(polar_rad, 2.0 * pi * concentrated(static_cast<double>(slice) / slices)));
        }
    }
    mesh.vertices_m.push_back(ball_point(pi, 0.0));
    const auto last = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
    for (std::uint32_t slice = 0; slice < across; ++slice) {
        const std::uint32_t next = (slice + 1) % across;
        mesh.triangles.push_back({0, 1 + slice, 1 + next});
        for (std::uint32_t first = 1; first + across < last; first += across) {
            const std::uint32_t below = first + across;
            mesh.triangles.push_back({first + slice, below + slice, below + next});
            mesh.triangles.push_back({first + slice, below + next, first + next});
        }
        mesh.triangles.push_back({last, last - across + next, last - across + slice});
    }
    return mesh;
}

std::vector<ShadedModel> shading_models(const std::vector<std::filesystem::path>& more) {
    std::vector<ShadedModel> all;
    const models::polygons::PolygonModel torus = models::procedural::torus(26, 8);
    models::TriangleMesh triangles = models::polygons::mesh_from_polygons(torus);
    triangles.materials = torus.materials;
    triangles.triangle_materials.assign(triangles.triangles.size(), 0);
    all.push_back(shaded_model("torus of 416 triangles", triangles, round_crease_rad));
    all.push_back(shaded_model("torus of 416 quads", models::procedural::torus(), round_crease_rad));
    for (const char* aircraft : {"f15", "500md"}) {
        all.push_back(shaded_model(aircraft, models::polygons::read_obj(base::aircraft_file(aircraft))));
    }
    all.push_back(shaded_model("uneven ball", uneven_ball(48, 97), round_crease_rad));
    for (const std::filesystem::path& file : more) {
        const auto hierarchy = world::read_refine_mesh({.file = file.string(), .base = 0, .quiet = true}).mesh;
        refine::SelectiveRefiner whole(hierarchy);
        for (std::uint32_t node = 0; node < hierarchy->node_count(); ++node) {
            if (!hierarchy->is_leaf(node)) { whole.split(node); }
        }
        const std::string name = file.stem().string();
        all.push_back(shaded_model(name, refine::active_mesh(whole).mesh, round_crease_rad));
        all.push_back(shaded_model(name + " refined", refined_mesh(hierarchy), round_crease_rad));
    }
    return all;
}

namespace {

/// A rule that selects the smooth polygons.
struct StudiedRule {
    const char* name;
    shading::ShadingRule rule;
    bool facing_only = false; ///< as if polygons that face away were not there
};

/// As ShadingRun::rules.
constexpr std::array studied_rules{StudiedRule{"random", shading::ShadingRule::Random},
    StudiedRule{"paper", shading::ShadingRule::Paper},
    StudiedRule{"paper, facing only", shading::ShadingRule::Paper, true},
    StudiedRule{"error (ours)", shading::ShadingRule::Error}};

/// Beyond this, a hundred thousandth of white, a picture counts as the same.
constexpr double exact_db = 100.0;

constexpr int views = 8;
constexpr std::uint64_t random_seeds = 4;
constexpr double distance_radii = 3.0;

/// The light of the study, from above and one side.
shading::ShadingLight study_light() {
    shading::ShadingLight light;
    light.ambient = 0.2F;
    light.diffuse = 0.7F;
    light.to_light = glm::normalize(glm::vec3(0.4F, 0.5F, -0.75F));
    return light;
}

/// Eight eyes around a model, three times its radius from its middle, above and below.
std::vector<glm::dvec3> study_eyes(const shading::ShadedPolygons& polygons) {
    constexpr std::array elevations_deg{25.0, 60.0, 5.0, -30.0};
    std::vector<glm::dvec3> eyes_m;
    for (std::size_t i = 0; i < views; ++i) {
        const double azimuth_rad = 2.0 * pi * (static_cast<double>(i) + 0.3) / views;
        const double elevation_rad = rad_from_deg(elevations_deg[i % elevations_deg.size()]);
        eyes_m.push_back(glm::dvec3(polygons.centre_m) + distance_radii * polygons.radius_m *
                                                             glm::dvec3(std::cos(elevation_rad) * std::cos(azimuth_rad),
                                                                 std::cos(elevation_rad) * std::sin(azimuth_rad),
                                                                 -std::sin(elevation_rad)));
    }
    return eyes_m;
}

std::vector<std::uint8_t> facing_polygons(const shading::ShadedPolygons& polygons, const glm::dvec3& eye_m) {
    std::vector<std::uint8_t> facing;
    for (const shading::ShadedPolygon& polygon : polygons.polygons) {
        const glm::vec3 to_eye_m = glm::vec3(eye_m) - polygon.centre_m;
        facing.push_back(glm::dot(polygon.normal, to_eye_m) > 0.0F ? 1 : 0);
    }
    return facing;
}

/// How many must be smooth so that `count` of them face the eye; all where fewer do. More smooth ones keep those that
/// fewer have.
int count_with_facing(
    shading::ShadingSelector& selector, const std::vector<std::uint8_t>& facing, const glm::dvec3& eye_m, int count) {
    int least = count;
    int most = static_cast<int>(facing.size());
    while (least < most) {
        const int middle = std::midpoint(least, most);
        const auto smooth = selector.choose(eye_m, study_light(), middle).smooth;
        if (std::inner_product(smooth.begin(), smooth.end(), facing.begin(), 0) < count) {
            least = middle + 1;
        } else {
            most = middle;
        }
    }
    return least;
}

/// Polygons that a rule makes smooth for one eye, nothing remembered. `share` is of all polygons; fewer where only
/// facing ones count and there are no more.
std::vector<std::uint8_t> smooth_polygons(const shading::ShadedPolygons& polygons, const StudiedRule& rule,
    const glm::dvec3& eye_m, double share, std::uint64_t seed = 1) {
    shading::ShadingRuleSettings settings = shading::without_hysteresis(rule.rule);
    settings.seed = seed;
    shading::ShadingSelector selector(polygons, settings);
    auto count = static_cast<int>(std::lround(share * static_cast<double>(polygons.size())));
    if (rule.facing_only) { count = count_with_facing(selector, facing_polygons(polygons, eye_m), eye_m, count); }
    const auto smooth = selector.choose(eye_m, study_light(), count).smooth;
    return {smooth.begin(), smooth.end()};
}

/// What pictures of one view are compared with.
struct References {
    LightPicture gouraud;
    LightPicture per_pixel;
};

void compare(const LightPicture& picture, const LightPicture& reference, const ShadingPictures& pictures, double weight,
    ShareQuality& quality) {
    quality.mean_square.back() += weight * mean_square_error(picture, reference, pictures.covered());
    quality.similarity += weight / views * structural_similarity(picture, reference, pictures.covered());
}

void run_rule(const ShadedModel& model, const StudiedRule& rule, const glm::dvec3& eye_m,
    const ShadingPictures& pictures, const References& references, RuleQuality& quality) {
    const std::uint64_t seeds = rule.rule == shading::ShadingRule::Random ? random_seeds : 1;
    for (std::size_t step = 0; step < share_steps; ++step) {
        quality.to_gouraud[step].mean_square.push_back(0.0);
        quality.to_per_pixel[step].mean_square.push_back(0.0);
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const double share = static_cast<double>(step) / (share_steps - 1);
            const LightPicture picture = pictures.hybrid(smooth_polygons(model.polygons, rule, eye_m, share, seed));
            const double weight = 1.0 / static_cast<double>(seeds);
            compare(picture, references.gouraud, pictures, weight, quality.to_gouraud[step]);
            compare(picture, references.per_pixel, pictures, weight, quality.to_per_pixel[step]);
        }
    }
}

} // namespace

double ShareQuality::psnr_db() const {
    const double sum = std::accumulate(mean_square.begin(), mean_square.end(), 0.0);
    return ui::studies::psnr_db(sum / static_cast<double>(mean_square.size()));
}

ShadingRun run_shading(const ShadedModel& model, int size_px, const std::function<void()>& tick) {
    ShadingRun run;
    run.name = model.name;
    run.polygons = model.polygons.size();
    for (const StudiedRule& rule : studied_rules) { run.rules.emplace_back().name = rule.name; }
    for (const glm::dvec3& eye_m : study_eyes(model.polygons)) {
        const ShadingPictures pictures(model.polygons, study_light(), eye_m, size_px);
        const std::vector<std::uint8_t> all(model.polygons.size(), 1);
        const References references{pictures.hybrid(all), pictures.per_pixel()};
        const auto facing = facing_polygons(model.polygons, eye_m);
        run.facing_share +=
            std::accumulate(facing.begin(), facing.end(), 0.0) / static_cast<double>(facing.size()) / views;
        for (std::size_t rule = 0; rule < studied_rules.size(); ++rule) {
            run_rule(model, studied_rules[rule], eye_m, pictures, references, run.rules[rule]);
        }
        tick();
    }
    return run;
}

namespace {

/// A made machine that draws frames in made times: t = a + bf f + bg g, with noise and now and then a slow frame. All
/// polygons flat take `flat_ms`, all smooth `smooth_ms` more.
struct SimulatedMachine {
    double fixed_ms = 3.0; ///< a
    double flat_ms = 3.0;
    double smooth_ms = 6.0;
    double noise = 0.02;      ///< standard deviation, share of a frame's time
    double slow_share = 0.01; ///< frames that take 1.6 times as long
};

/// How the share of smooth polygons followed a made machine's times.
struct ControlRun {
    SimulatedMachine machine;
    double target_frame_ms = 0.0; ///< T
    /// From the start, and after a rises and falls again: frames before the share is within 0.1 of the best one, or
    /// within 2.5 deviations of the noise, for good.
    std::array<int, 3> settled_frames{};
    std::array<double, 3> best_share{};
    double over_share = 0.0;         ///< frames longer than T
    double changes_per_second = 0.0; ///< per polygon at 60 frames a second, once settled
    bool has_no_gain = false;        ///< at the end
};

constexpr int frames_per_load = 600;
constexpr int settling_frames = 30;
constexpr double frames_per_second = 60.0;
constexpr double added_fixed_ms = 2.0;
constexpr int torus_polygons = 416;

double best_share(const SimulatedMachine& machine, const shading::ShadingControllerSettings& control) {
    if (machine.smooth_ms <= 0.0) { return 1.0; }
    const double aim_ms = control.target_frame_ms * (1.0 - control.target_margin_sds * machine.noise);
    return std::clamp((aim_ms - machine.fixed_ms - machine.flat_ms) / machine.smooth_ms, 0.0, 1.0);
}

double near_share(const SimulatedMachine& machine, double target_frame_ms) {
    const double noise_ms = machine.noise * target_frame_ms;
    return machine.smooth_ms > 0.0 ? std::max(0.1, 2.5 * noise_ms / machine.smooth_ms) : 0.1;
}

double frame_ms(const SimulatedMachine& machine, double smooth_part, RandomGenerator& dice) {
    const double mean_ms = machine.fixed_ms + machine.flat_ms + machine.smooth_ms * smooth_part;
    const double slow = dice.next() < machine.slow_share ? 1.6 : 1.0;
    return mean_ms * slow * (1.0 + machine.noise * dice.normal_deviate());
}

/// 600 frames each with `machine`, with 2 ms more rest and with `machine` again.
ControlRun run_control(const SimulatedMachine& machine, double target_frame_ms, int polygons) {
    ControlRun run{.machine = machine, .target_frame_ms = target_frame_ms};
    shading::ShadingControllerSettings control;
    control.target_frame_ms = target_frame_ms;
    shading::ShadingState state = shading::initial_shading_state(polygons);
    RandomGenerator dice(2008);
    double changes = 0.0;
    for (std::size_t load = 0; load < run.settled_frames.size(); ++load) {
        SimulatedMachine now = machine;
        now.fixed_ms += load == 1 ? added_fixed_ms : 0.0;
        run.best_share[load] = best_share(now, control);
        for (int frame = 0; frame < frames_per_load; ++frame) {
            const double part = static_cast<double>(state.smooth) / polygons;
            if (std::abs(part - run.best_share[load]) > near_share(now, target_frame_ms)) {
                run.settled_frames[load] = frame + 1;
            }
            const double ms = frame_ms(now, part, dice);
            run.over_share += ms > target_frame_ms ? 1.0 : 0.0;
            const int before = state.smooth;
            state = update_shading(state, control, {ms, polygons - before, before}, polygons);
            changes += frame >= settling_frames ? std::abs(state.smooth - before) : 0.0;
        }
    }
    const auto loads = static_cast<double>(run.settled_frames.size());
    run.over_share /= loads * frames_per_load;
    run.changes_per_second = changes / polygons / (loads * (frames_per_load - settling_frames)) * frames_per_second;
    run.has_no_gain = state.has_no_gain;
    return run;
}

/// The machines and budgets of the study.
std::vector<ControlRun> control_runs() {
    std::vector<ControlRun> runs;
    for (const double smooth_ms : {-1.0, 0.0, 2.0, 6.0, 20.0}) {
        for (const double target_frame_ms : {7.0, 10.0, 12.0, 16.7, 33.3}) {
            runs.push_back(run_control({.smooth_ms = smooth_ms}, target_frame_ms, torus_polygons));
        }
    }
    return runs;
}

constexpr int printed_polygons = 415;
constexpr double printed_device_ratio = 0.028;

std::string decibels(double db) { return db < exact_db ? fmt::format("{:.2f}", db) : "exact"; }

std::string gain_text(double ours_db, double gain_db) {
    return ours_db < exact_db ? fmt::format("{:.2f}", gain_db) : "exact";
}

/// Smallest gain of any view; infinite where each is exact.
double min_gain_db(const ShareQuality& ours, const ShareQuality& theirs) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t view = 0; view < ours.mean_square.size(); ++view) {
        if (ours.mean_square[view] > 0.0) {
            least = std::min(least, psnr_db(ours.mean_square[view]) - psnr_db(theirs.mean_square[view]));
        }
    }
    return least;
}

/// Operation counts as the 2008 paper has them in section 4 and table 2: every polygon costs 9 operations for the
/// choice, then 1 when it is flat and 4 when it is smooth. n is the number of polygons, g of smooth ones, f = n - g of
/// flat ones.
struct OperationCounts {
    int selection = 0;  ///< 9 n
    int all_flat = 0;   ///< 9 n + n
    int all_smooth = 0; ///< 9 n + 4 n
    int hybrid = 0;     ///< 9 n + f + 4 g
};

/// The row that the paper prints for 415 polygons with 9 smooth ones. Its 5408 is 13 x 416, for the torus has 416
/// polygons; 13 x 415 would be 5395.
constexpr OperationCounts paper_counts{.selection = 3735, .all_flat = 4150, .all_smooth = 5408, .hybrid = 4177};

/// The counts for n polygons (at least 0) of which g (0 to n, asserted) are smooth.
constexpr OperationCounts operation_counts(int polygons, int smooth) {
    assert(smooth >= 0 && smooth <= polygons);
    const int selection = 9 * polygons;
    return {.selection = selection,
        .all_flat = selection + polygons,
        .all_smooth = selection + 4 * polygons,
        .hybrid = selection + (polygons - smooth) + 4 * smooth};
}

static_assert(operation_counts(415, 9).selection == paper_counts.selection &&
              operation_counts(415, 9).all_flat == paper_counts.all_flat &&
              operation_counts(415, 9).hybrid == paper_counts.hybrid);
static_assert(
    operation_counts(415, 9).all_smooth == 5395 && operation_counts(416, 0).all_smooth == paper_counts.all_smooth);
static_assert(operation_counts(416, 0).hybrid == operation_counts(416, 0).all_flat &&
              operation_counts(416, 416).hybrid == operation_counts(416, 0).all_smooth);

/// Table 2 of the 2008 paper with the counts computed beside, its slip marked.
report::ResultTable operation_table() {
    const int smooth = shading::device_smooth_count(printed_device_ratio, printed_polygons);
    const auto counts = operation_counts(printed_polygons, smooth);
    const auto whole = operation_counts(printed_polygons + 1, smooth);
    const auto& printed = paper_counts;
    report::ResultTable table{fmt::format("Operations for a torus, table 2 ({} smooth)", smooth)};
    const auto add = [&](const char* what, const char* formula, int shown, int here, int all) {
        table.add(
            {{"what", what}, {"formula", formula}, {"printed, n = 415", "{}{}", shown, shown == here ? "" : " (slip)"},
                {"computed, n = 415", here}, {"n = 416", all}});
    };
    add("deciding", "9 n", printed.selection, counts.selection, whole.selection);
    add("all flat", "9 n + n", printed.all_flat, counts.all_flat, whole.all_flat);
    add("all Gouraud", "9 n + 4 n", printed.all_smooth, counts.all_smooth, whole.all_smooth);
    add("hybrid", "9 n + f + 4 g", printed.hybrid, counts.hybrid, whole.hybrid);
    table.note = fmt::format("The torus has 416 triangles (26 x 8 quads in two each; 26 x 9 = 234 vertices with one "
                             "seam "
                             "doubled); 5408 is 13 x 416, the other rows are of 415. g = {} of 415 is what the mapping "
                             "here, round(r n (10 + 3 r) / 13), gives for the paper's relative speed r = {}: the paper "
                             "says 8 or 9 and not why.",
        smooth, printed_device_ratio);
    return table;
}

/// What the error rule gains over the paper's at few smooth polygons, in decibels.
report::ResultTable gain_table(std::span<const ShadingRun> runs) {
    report::ResultTable table{"Gain of the error rule over the paper's, PSNR against all Gouraud"};
    for (const ShadingRun& run : runs) {
        for (std::size_t step = 1; step <= 3; ++step) {
            const auto& random = run.rules[random_rule].to_gouraud[step];
            const auto& theirs = run.rules[paper_rule].to_gouraud[step];
            const auto& facing = run.rules[facing_rule].to_gouraud[step];
            const auto& ours = run.rules[error_rule].to_gouraud[step];
            const double gain_db = ours.psnr_db() - theirs.psnr_db();
            table.add({{"model", run.name}, {"polygons", run.polygons},
                {"facing the eye", "{:.1f} %", 100.0 * run.facing_share}, {"smooth", "{} %", step * share_step_percent},
                {"random, dB", decibels(random.psnr_db())}, {"paper, dB", decibels(theirs.psnr_db())},
                {"paper, facing only, dB", decibels(facing.psnr_db())}, {"error (ours), dB", decibels(ours.psnr_db())},
                {"gain over paper, dB", gain_text(ours.psnr_db(), gain_db)},
                {"least of a view, dB", gain_text(ours.psnr_db(), min_gain_db(ours, theirs))},
                {"over facing only, dB", gain_text(ours.psnr_db(), ours.psnr_db() - facing.psnr_db())},
                {"at least 2 dB", gain_db >= 2.0 ? "yes" : "no"}});
        }
    }
    table.note = "Share of all polygons of the model, those that face away included. Eight eyes around the "
                 "model, three radii from its middle; PSNR of the mean square error over all covered pixels "
                 "of all eyes, white = R + G + B = 3 in display values. Facing only: the paper's "
                 "rule as if polygons that face away were not there. Exact: beyond 100 dB, a hundred "
                 "thousandth of white. Random: mean square of four seeds.";
    return table;
}

/// PSNR and SSIM of one model over the share of smooth polygons, all rules, both references.
report::ResultTable quality_table(const ShadingRun& run) {
    report::ResultTable table{fmt::format("{}: quality over the share of smooth polygons", run.name)};
    for (std::size_t step = 0; step < share_steps; ++step) {
        std::vector<report::Cell> row = {{"smooth", "{} %", step * share_step_percent}};
        for (const auto& [reference, name] :
            {std::pair(&RuleQuality::to_gouraud, "Gouraud"), std::pair(&RuleQuality::to_per_pixel, "per pixel")}) {
            for (const RuleQuality& rule : run.rules) {
                row.emplace_back(
                    fmt::format("PSNR, dB to {}, {}", name, rule.name), decibels((rule.*reference)[step].psnr_db()));
            }
            for (const RuleQuality& rule : run.rules) {
                row.push_back(
                    {fmt::format("SSIM to {}, {}", name, rule.name), "{:.4f}", (rule.*reference)[step].similarity});
            }
        }
        table.add(std::move(row));
    }
    table.note = fmt::format("{} polygons, {:.1f} % of them face the eye. Exact: beyond 100 dB. To Gouraud: all "
                             "polygons smooth; per pixel: normals between corners (Phong's shading).",
        run.polygons, 100.0 * run.facing_share);
    return table;
}

/// How the share of smooth polygons followed made frame times.
report::ResultTable control_table(std::span<const ControlRun> runs) {
    report::ResultTable table{"The share of smooth polygons found from frame times"};
    for (const ControlRun& run : runs) {
        table.add({{"all smooth cost more, ms", "{:g}", run.machine.smooth_ms}, {"T, ms", "{:g}", run.target_frame_ms},
            {"best share, a = 3 / 5 / 3 ms", "{:.2f} / {:.2f} / {:.2f}", run.best_share[0], run.best_share[1],
                run.best_share[2]},
            {"settled after, frames", "{} / {} / {}", run.settled_frames[0], run.settled_frames[1],
                run.settled_frames[2]},
            {"frames over T", "{:.1f} %", 100.0 * run.over_share},
            {"class changes per polygon and second", "{:.3f}", run.changes_per_second},
            {"flat gains", run.has_no_gain ? "nothing: all smooth" : "time"}});
    }
    const SimulatedMachine machine;
    table.note = fmt::format("A made clock, 416 polygons: all flat take {:g} ms and a; noise of {:g} % (deviation), "
                             "{:g} % of the frames 1.6 times as long; 600 frames each of three loads. Best share: the "
                             "expected time is 2.6 deviations below T. Settled: within 0.1 of it, or 2.5 deviations of "
                             "the noise, for good. Changes: from the 31st frame of each load on, 60 frames a second, "
                             "still camera. Where smooth ones gain nothing, and where even all flat takes longer than "
                             "T, "
                             "frames over T are nobody's fault.",
        machine.flat_ms, 100.0 * machine.noise, 100.0 * machine.slow_share);
    return table;
}

constexpr int timed_frames = 100;
constexpr int warm_up_frames = 10;

struct ShadingMode {
    const char* name;
    scene::AircraftShading shading;
    double share = 1.0;
    scene::HybridRule rule = scene::HybridRule::Error;
};

constexpr std::array shading_modes{ShadingMode{"flat", scene::AircraftShading::Flat},
    ShadingMode{"hybrid, 20 %", scene::AircraftShading::Hybrid, 0.2},
    ShadingMode{"hybrid, 20 %, paper's rule", scene::AircraftShading::Hybrid, 0.2, scene::HybridRule::Paper},
    ShadingMode{"hybrid, 50 %", scene::AircraftShading::Hybrid, 0.5},
    ShadingMode{"Gouraud", scene::AircraftShading::Gouraud}, ShadingMode{"Phong", scene::AircraftShading::Phong}};
constexpr std::size_t flat_way = 0; ///< index into shading_modes

constexpr auto renderer_modes = [] {
    using enum settings::RendererKind;
    using enum scene::HiddenSurface;
    using enum visuals::raster::Renderer::PaintDirection;
    return std::array{DrawingMode{"OpenGL", Gl, Octant},
        DrawingMode{"raster, far to near", Raster, Octant, 1, FarToNear}, DrawingMode{"raster, near to far", Raster},
        DrawingMode{"raster, depth buffer", Raster, DepthBuffer},
        DrawingMode{"raster, 16 samples", Raster, Octant, 16}};
}();
constexpr std::size_t near_to_far_drawer = 2; ///< indices into renderer_modes
constexpr std::size_t depth_drawer = 3;

/// An orbit, so that the choice of smooth polygons changes, without ground.
settings::RunSettings orbit_settings(const std::string& aircraft, int frames) {
    settings::RunSettings settings;
    settings.path.name = "turn";
    settings.view.kind = scene::View::Orbit;
    settings.path.terrain = "none";
    settings.path.aircraft = {aircraft};
    settings.time.frames = frames;
    settings.time.warm_up = 0;
    return settings;
}

/// Every way of shading by every renderer: those of the first way first.
TimedFlight fly_shading_modes(const std::string& aircraft, bool quiet) {
    Sessions sessions;
    for (const ShadingMode& way : shading_modes) {
        settings::RunSettings settings = orbit_settings(aircraft, timed_frames);
        settings.shading.kind = way.shading;
        settings.shading.rule = way.rule;
        settings.shading.far_m = 1e6; // by the share alone
        settings.shading.smooth_share = way.share;
        for (const DrawingMode& drawer : renderer_modes) { sessions.push_back(session_of(settings, drawer)); }
    }
    return draw_in_turn(sessions, {.frames = timed_frames,
                                      .left_out = warm_up_frames,
                                      .name = fmt::format("{} flown", aircraft),
                                      .quiet = quiet});
}

/// Median of the planning of some sessions' frames that count, without refining.
double plan_ms_of(std::span<const Records> sessions) {
    std::vector<double> plan_ms;
    for (const Records& records : sessions) {
        for (const report::FrameRecord& record : std::span(records).subspan(warm_up_frames)) {
            plan_ms.push_back(record.plan_ms - record.refine_ms);
        }
    }
    return median_of(std::move(plan_ms));
}

/// Frame times of aircraft flown with all polygons flat, all smooth, and shares between: medians of flights that draw
/// every frame in turn. These times are the machine's, not the same twice. `aircraft`: as --aircraft. Throws Error.
report::ResultTable shading_times_table(std::span<const std::string> aircraft, bool quiet) {
    report::ResultTable table{"Times flown: drawing by each renderer, ms, and over that of all flat"};
    for (const std::string& each : aircraft) {
        const TimedFlight flight = fly_shading_modes(each, quiet);
        const auto draw_ms = [&](std::size_t way, std::size_t drawer) {
            return flight.median(way * renderer_modes.size() + drawer, &report::FrameRecord::draw_ms);
        };
        for (std::size_t way = 0; way < shading_modes.size(); ++way) {
            const auto own = std::span(flight.records).subspan(way * renderer_modes.size(), renderer_modes.size());
            const report::FrameRecord& last = own.back().back();
            std::vector<report::Cell> row = {{"aircraft", std::filesystem::path(each).stem().string()},
                {"shading", shading_modes[way].name}, {"polygons drawn", last.aircraft_polygons},
                {"smooth", last.smooth_polygons}, {"planning, ms", "{:.3f}", plan_ms_of(own)}};
            for (std::size_t drawer = 0; drawer < renderer_modes.size(); ++drawer) {
                const double ms = draw_ms(way, drawer);
                row.push_back({fmt::format("{}, ms", renderer_modes[drawer].name), "{:.2f}", ms});
                row.push_back(
                    {fmt::format("{}, / flat", renderer_modes[drawer].name), "{:.2f}", ms / draw_ms(flat_way, drawer)});
            }
            row.push_back({"raster: depth buffer / near to far", "{:.2f}",
                draw_ms(way, depth_drawer) / draw_ms(way, near_to_far_drawer)});
            table.add(std::move(row));
        }
    }
    table.note =
        fmt::format("Medians of {} frames of the path turn without ground, orbit view, 1280 x 720, one sample "
                    "a pixel where none are named, all frame by frame beside each other. Drawing: from the "
                    "plan to pixels in memory, sky included. Counts are the last frame's: of polygon models "
                    "those in view of the eye's cell and the smooth ones of the whole model, of meshes "
                    "triangles as they are refined. Planning: without refining; the choice of smooth polygons "
                    "and the writing of refined meshes included. Times are the machine's, not the same twice. "
                    "In the paper's count of operations Gouraud costs 1.3 times as much as flat, on devices "
                    "that divided for each pixel; the columns say what it costs here, and what light in each "
                    "pixel (Phong) does. The last columns paint by a depth buffer, which asks for depth in each "
                    "sample of the aircraft and is not tuned as the painter is.",
            timed_frames - warm_up_frames);
    return table;
}

constexpr int budget_frames = 300;
constexpr int unsettled_frames = 100;
constexpr int clock_frames = 60; ///< of all flat and all Gouraud, to find the budgets
constexpr double clock_rate_hz = 500.0;

/// Budgets: so many of the way from what all flat takes (0) to what all Gouraud takes (1).
constexpr std::array budgets{-3.0, 0.5, 4.0};
constexpr double min_way = 0.1; ///< of all flat's time

constexpr std::array budget_modes{
    scene::AircraftShading::Flat, scene::AircraftShading::Gouraud, scene::AircraftShading::Hybrid};
constexpr std::size_t flat_flight = 0; ///< indices into budget_modes
constexpr std::size_t smooth_flight = 1;
constexpr std::size_t budget_flight = 2;

struct BudgetFlights {
    TimedFlight flight;               ///< by budget_modes
    std::vector<double> smooth_share; ///< of the adapted flight's frames that count
    bool has_no_gain = false;

    /// Frames that took longer than the budget.
    double share_over(std::size_t mode, double budget_ms) const {
        const auto times_ms = flight.values(mode, &report::FrameRecord::frame_ms);
        const auto over = std::ranges::count_if(times_ms, [&](double ms) { return ms > budget_ms; });
        return static_cast<double>(over) / static_cast<double>(times_ms.size());
    }
};

/// Flies the first `ways` of budget_modes in turn; the first frames do not count.
BudgetFlights fly_all(const std::string& aircraft, std::size_t ways, double rate_hz, int frames, int left_out) {
    Sessions sessions;
    for (std::size_t mode = 0; mode < ways; ++mode) {
        settings::RunSettings settings = orbit_settings(aircraft, frames);
        settings.time.rate_hz = rate_hz;
        settings.drawing.renderer = settings::RendererKind::Raster;
        settings.shading.kind = budget_modes[mode];
        settings.adapt.shading = mode == budget_flight;
        sessions.push_back(std::make_unique<flight::Session>(settings));
    }
    BudgetFlights flights;
    const auto note_share = [&](int frame, const std::vector<Records>& so_far) {
        if (ways > budget_flight && frame >= left_out) {
            flights.smooth_share.push_back(static_cast<double>(so_far[budget_flight].back().smooth_polygons) /
                                           std::max(sessions[budget_flight]->shading()->polygons, 1));
        }
        return true;
    };
    flights.flight = draw_in_turn(sessions, {.frames = frames, .left_out = left_out, .after_frame = note_share});
    flights.has_no_gain = ways > budget_flight && sessions[budget_flight]->shading()->has_no_gain;
    return flights;
}

std::vector<report::Cell> cells_of(const std::string& aircraft, double budget_ms, const BudgetFlights& flights) {
    constexpr std::array names = {"all flat", "all Gouraud", "adapted"}; // of budget_modes
    std::vector<report::Cell> cells = {{"aircraft", aircraft}, {"budget T, ms", "{:.2f}", budget_ms}};
    for (std::size_t mode = 0; mode < names.size(); ++mode) {
        cells.push_back({fmt::format("{}, ms", names[mode]), "{:.2f}", flights.flight.median(mode)});
        cells.push_back({"over T", "{:.0f} %", 100.0 * flights.share_over(mode, budget_ms)});
    }
    cells.push_back({"flat polygons", "{:.0f} %", 100.0 * (1.0 - median_of(flights.smooth_share))});
    cells.emplace_back("flat gains", flights.has_no_gain ? "nothing: all smooth" : "time");
    return cells;
}

/// What `--adapt shading` makes of budgets below, between and above the times that all flat and all Gouraud take, by
/// the raster renderer: three flights draw every frame in turn, so that they see the same machine. These times are the
/// machine's, not the same twice. `aircraft`: as --aircraft. Throws Error.
report::ResultTable budget_times_table(std::span<const std::string> aircraft, bool quiet) {
    report::ResultTable table{
        "Adaptation flown: what a budget makes of the share of flat polygons, raster, 16 samples"};
    base::Progress progress("budgets", static_cast<int>(aircraft.size() * budgets.size()), quiet, "flights");
    for (const std::string& each : aircraft) {
        const TimedFlight clock = fly_all(each, budget_flight, clock_rate_hz, clock_frames, 10).flight;
        const double flat_ms = clock.median(flat_flight);
        const double way_ms = std::max(clock.median(smooth_flight) - flat_ms, min_way * flat_ms);
        for (const double budget : budgets) {
            const double budget_ms = flat_ms + budget * way_ms;
            const BudgetFlights flights =
                fly_all(each, budget_modes.size(), 1000.0 / budget_ms, budget_frames, unsettled_frames);
            table.add(cells_of(std::filesystem::path(each).stem().string(), budget_ms, flights));
            progress.tick();
        }
    }
    progress.finish();
    table.note =
        fmt::format("Medians of {} frames after {} of the path turn without ground, orbit view, 1280 x 720; "
                    "the three flights draw every frame in turn. Budgets lie below what all flat took in a "
                    "flight before, half way from all flat to all Gouraud and well above both; a tenth of all "
                    "flat's time counts as that way where it is shorter. Flat gains: what the control has "
                    "found out; where flat polygons take as long as smooth ones, to within the noise, it makes "
                    "all smooth whatever the budget is, for fewer would only look worse.",
            budget_frames - unsettled_frames, unsettled_frames);
    return table;
}

constexpr double strip_share = 0.2;
constexpr float shown_as_white = 2.4F; ///< light of the pictures; errors are shown eightfold
constexpr float error_scale = 8.0F;
constexpr std::byte background{40};

/// Name in file names.
std::string file_part(std::string name) {
    std::ranges::replace(name, ' ', '-');
    return name;
}

std::byte grey_of(float light) {
    const float part = std::clamp(light / shown_as_white, 0.0F, 1.0F);
    return static_cast<std::byte>(std::lround(255.0F * part));
}

/// Pictures side by side, below them their differences from the last but one.
report::Picture strip_of(const std::vector<LightPicture>& row, const std::vector<std::uint8_t>& on) {
    const auto size = static_cast<std::size_t>(row.front().size_px);
    const LightPicture& reference = row[row.size() - 2];
    report::Picture strip;
    strip.width_px = static_cast<int>(size * row.size());
    strip.height_px = static_cast<int>(2 * size);
    strip.bytes.assign(std::size_t{6} * size * size * row.size(), background);
    for (std::size_t k = 0; k < row.size(); ++k) {
        for (std::size_t at = 0; at < size * size; ++at) {
            if (on[at] == 0) { continue; }
            const float light = row[k].light[at];
            const float error = error_scale * std::abs(light - reference.light[at]);
            const std::size_t column = k * size + at % size;
            const std::size_t above = at / size * size * row.size() + column;
            const std::size_t below = above + size * size * row.size();
            std::fill_n(strip.bytes.begin() + static_cast<std::ptrdiff_t>(3 * above), 3, grey_of(light));
            std::fill_n(strip.bytes.begin() + static_cast<std::ptrdiff_t>(3 * below), 3, grey_of(error));
        }
    }
    return strip;
}

report::Picture strip_of(const ShadedModel& model, int size_px) {
    const glm::dvec3 eye_m = study_eyes(model.polygons).front();
    const ShadingPictures pictures(model.polygons, study_light(), eye_m, size_px);
    std::vector<LightPicture> row;
    row.push_back(pictures.hybrid(std::vector<std::uint8_t>(model.polygons.size(), 0)));
    for (const StudiedRule& rule : studied_rules) {
        row.push_back(pictures.hybrid(smooth_polygons(model.polygons, rule, eye_m, strip_share)));
    }
    row.push_back(pictures.hybrid(std::vector<std::uint8_t>(model.polygons.size(), 1)));
    row.push_back(pictures.per_pixel());
    return strip_of(row, pictures.covered());
}

report::Plot curve_plot(const ShadingRun& run) {
    constexpr std::array colours{"#888888", "#d62728", "#ff9f40", "#1f77b4"};
    report::Plot plot;
    plot.title = fmt::format("{}, {} polygons", run.name, run.polygons);
    plot.x_label = "smooth polygons, %";
    plot.y_label = "PSNR, dB";
    for (std::size_t rule = 0; rule < studied_rules.size(); ++rule) {
        report::PlotSeries series;
        series.name = studied_rules[rule].name;
        series.colour = colours[rule];
        for (std::size_t step = 0; step < share_steps; ++step) {
            series.x.push_back(static_cast<double>(step * share_step_percent));
            const double db = run.rules[rule].to_gouraud[step].psnr_db();
            series.y.push_back(db < exact_db ? db : std::numeric_limits<double>::infinity());
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

void add_figures(Study& study, const ShadingStudyOptions& options, const std::vector<ShadedModel>& models,
    const std::vector<ShadingRun>& runs) {
    std::vector<report::Plot> plots;
    for (const ShadingRun& run : runs) { plots.push_back(curve_plot(run)); }
    study.add(plots, "PSNR against all Gouraud; a curve ends where it is exact.");
    for (const ShadedModel& model : models) {
        study.add("strip-" + file_part(model.name) + ".png", strip_of(model, options.size_px).view(),
            fmt::format(
                "{}: all flat; {:.0f} % smooth at random, by the paper's rule, by the same among polygons that "
                "face the eye, by the error; all Gouraud; each pixel. Below: difference from all Gouraud, {:.0f} "
                "times.",
                model.name, 100.0 * strip_share, error_scale));
    }
}

} // namespace

void study_shading(const ShadingStudyOptions& options) {
    const std::vector<ShadedModel> models = shading_models(options.meshes);
    Study study(options);
    base::Progress progress("models", static_cast<int>(models.size() * views), options.quiet, "views");
    const std::vector<ShadingRun> runs = run_cases(models, options, [&](const ShadedModel& model, bool /*quiet*/) {
        return run_shading(model, options.size_px, [&] { progress.tick(model.name); });
    });
    progress.finish();
    study.add("operations", operation_table());
    study.add("gain", gain_table(runs));
    study.add("control", control_table(control_runs()));
    for (const ShadingRun& run : runs) { study.add("quality-" + file_part(run.name), quality_table(run)); }
    if (options.times) {
        std::vector<std::string> aircraft{"f15", "500md"};
        for (const std::filesystem::path& mesh : options.meshes) { aircraft.push_back(mesh.string()); }
        study.add("times", shading_times_table(aircraft, options.quiet));
        study.add("held", budget_times_table(aircraft, options.quiet));
    }
    add_figures(study, options, models, runs);
    study.finish("shading");
}

} // namespace octant::ui::studies::hybrid_shading
