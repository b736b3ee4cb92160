#include "sim/base/random_generator.h"
#include "ui/flight/quality_controller.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

using namespace octant;
using namespace octant::ui::flight;
using ui::flight::FrameMeasurement;
using ui::flight::QualityController;
using ui::flight::QualityTargets;
using visuals::scene::Settings;

namespace {

constexpr double tested_rate_hz = 50.0;

Settings adapting(bool terrain, bool shading) {
    Settings settings;
    settings.ground.triangles = 40000;
    settings.adapt.terrain = terrain;
    settings.adapt.shading = shading;
    return settings;
}

QualityController begun(const Settings& settings) {
    QualityController quality_controller;
    quality_controller.begin(settings, tested_rate_hz);
    return quality_controller;
}

/// A frame of a machine that takes a microsecond for each triangle of ground and ten for each smooth polygon.
FrameMeasurement frame_of(int triangles, int smooth, int polygons) {
    FrameMeasurement measurement;
    measurement.frame_ms = 1e-3 * triangles + 1e-2 * smooth;
    measurement.terrain_triangles = triangles;
    measurement.smoothable_polygons = polygons;
    measurement.smooth_polygons = smooth;
    return measurement;
}

} // namespace

TEST_CASE("without adaptation every frame is decided as the settings say, whatever frames take") {
    Settings settings;
    settings.ground.triangles = 5000;
    QualityController quality_controller = begun(settings);
    for (int frame = 0; frame < 5; ++frame) {
        CHECK(quality_controller.triangle_target(frame) == 5000);
        CHECK_FALSE(quality_controller.smooth_target(frame));
        CHECK(quality_controller.add_frame(frame_of(40000, 0, 0)) == Approx(2.0));
    }
    CHECK_FALSE(quality_controller.shading());
}

TEST_CASE("the triangle target falls to what the frame's time allows, and stays there") {
    const Settings settings = adapting(true, false);
    QualityController quality_controller = begun(settings);
    CHECK(quality_controller.triangle_target(0) == 40000);
    double stress = 0.0;
    int frame = 0;
    for (; frame < 600; ++frame) {
        stress = quality_controller.add_frame(frame_of(quality_controller.triangle_target(frame), 0, 0));
    }
    CHECK(stress > 0.75);
    CHECK(stress < 0.90);
    const int settled = quality_controller.triangle_target(frame);
    CHECK(settled > 15000); // of 20,000 that a frame has time for
    CHECK(settled < 18000);
    quality_controller.add_frame(frame_of(settled, 0, 0));
    CHECK(quality_controller.triangle_target(frame + 1) == settled);
}

TEST_CASE("frames of the warm-up teach nothing") {
    QualityController quality_controller = begun(adapting(true, true));
    for (int frame = 0; frame < 50; ++frame) {
        FrameMeasurement slow = frame_of(100000, 10, 100);
        slow.warm_up = true;
        CHECK(std::isnan(quality_controller.add_frame(slow)));
    }
    CHECK(quality_controller.triangle_target(50) == 40000);
    CHECK(quality_controller.smooth_target(50) == 0);
    CHECK_FALSE(quality_controller.shading());
}

TEST_CASE("all polygons begin flat, and as many turn smooth as there is time for") {
    const Settings settings = adapting(false, true);
    QualityController quality_controller = begun(settings);
    CHECK(quality_controller.smooth_target(0) == 0);
    constexpr int polygons = 3000; // all of them smooth would take 30 ms, a frame has 20
    std::optional<int> smooth;
    for (int frame = 0; frame < 400; ++frame) {
        smooth = quality_controller.smooth_target(frame);
        REQUIRE(smooth);
        quality_controller.add_frame(frame_of(5000, *smooth, polygons));
    }
    REQUIRE(quality_controller.shading());
    CHECK(*smooth > 1000);
    CHECK(*smooth <= 1500);
}

TEST_CASE("aircraft without polygons that could be smooth do not begin the shading's control") {
    const Settings settings = adapting(false, true);
    QualityController quality_controller = begun(settings);
    quality_controller.add_frame(frame_of(5000, 0, 0));
    CHECK_FALSE(quality_controller.shading());
    CHECK(quality_controller.smooth_target(1) == 0);
}

TEST_CASE("a replay decides as it was recorded, whatever frames take, and through a new start") {
    const Settings settings = adapting(true, true);
    QualityController quality_controller = begun(settings);
    quality_controller.replay({{1000, std::nullopt}, {2000, 7}, {1500, 0}});
    const auto check = [&] {
        CHECK(quality_controller.triangle_target(0) == 1000);
        CHECK_FALSE(quality_controller.smooth_target(0));
        quality_controller.add_frame(frame_of(100000, 50, 100));
        CHECK(quality_controller.triangle_target(1) == 2000);
        CHECK(quality_controller.smooth_target(1) == 7);
        quality_controller.add_frame(frame_of(100000, 50, 100));
        CHECK(quality_controller.triangle_target(2) == 1500);
        CHECK(quality_controller.smooth_target(2) == 0);
    };
    check();
    quality_controller.begin(settings, tested_rate_hz);
    check();
}

TEST_CASE("decisions that followed the clock are the same when they are replayed") {
    const Settings settings = adapting(true, false);
    QualityController live = begun(settings);
    std::vector<QualityTargets> quality_targets;
    for (int frame = 0; frame < 100; ++frame) {
        quality_targets.push_back({live.triangle_target(frame), std::nullopt});
        live.add_frame(frame_of(quality_targets.back().triangle_target, 0, 0));
    }
    QualityController replayed = begun(settings);
    replayed.replay(quality_targets);
    for (int frame = 0; frame < 100; ++frame) {
        CHECK(replayed.triangle_target(frame) == quality_targets[static_cast<std::size_t>(frame)].triangle_target);
        replayed.add_frame(frame_of(replayed.triangle_target(frame), 0, 0));
    }
}

TEST_CASE("a new start forgets what frames took") {
    const Settings settings = adapting(true, true);
    QualityController quality_controller = begun(settings);
    for (int frame = 0; frame < 100; ++frame) { quality_controller.add_frame(frame_of(100000, 10, 100)); }
    CHECK(quality_controller.triangle_target(100) < 40000);
    quality_controller.begin(settings, tested_rate_hz);
    CHECK(quality_controller.triangle_target(0) == 40000);
    CHECK_FALSE(quality_controller.shading());
}

namespace {

/// A machine: a frame takes fixed_ms + ms_per_triangle * triangles, more or less.
struct Machine {
    double fixed_ms = 3.0;
    double ms_per_triangle = 0.0005;
    double noise = 0.0; ///< share of the frame time, either way
    RandomGenerator dice{7};

    double frame_ms(int triangles) {
        const double exact_ms = fixed_ms + ms_per_triangle * triangles;
        return exact_ms * (1.0 + dice.between(-noise, noise));
    }
};

StressSettings settings_at(double rate_hz, int budget = 20000) {
    visuals::scene::Settings settings;
    settings.ground.triangles = budget;
    settings.adapt.terrain = true;
    return stress_settings(settings, rate_hz);
}

/// The targets of so many frames, each checked against the limits of the settings.
std::vector<int> fly(StressState& state, const StressSettings& settings, Machine& machine, int frames) {
    std::vector<int> targets;
    bool is_within_limits = true;
    for (int frame = 0; frame < frames; ++frame) {
        targets.push_back(state.triangles());
        const StressState next = next_state(state, settings, {machine.frame_ms(state.triangles()), state.triangles()});
        is_within_limits = is_within_limits && next.target >= settings.min_triangles &&
                           next.target <= settings.max_triangles &&
                           next.target >= state.target * (1.0 - settings.max_fall) * (1.0 - 1e-12) &&
                           next.target <= state.target * (1.0 + settings.max_rise) * (1.0 + 1e-12);
        state = next;
    }
    REQUIRE(is_within_limits);
    return targets;
}

bool all_same(const std::vector<int>& targets, std::size_t from) {
    return std::all_of(targets.begin() + static_cast<std::ptrdiff_t>(from), targets.end(),
        [&](int target) { return target == targets[from]; });
}

double stress_of(const Machine& machine, const StressSettings& settings, const StressState& state) {
    return (machine.fixed_ms + machine.ms_per_triangle * state.target) / settings.target_frame_ms;
}

} // namespace

TEST_CASE("a target lies between an eighth of the budget and four times, however large that is") {
    CHECK(settings_at(60.0, 20'000).min_triangles == 2'500);
    CHECK(settings_at(60.0, 20'000).max_triangles == 80'000);
    const StressSettings large = settings_at(60.0, 1'000'000'000);
    CHECK(large.min_triangles == 125'000'000);
    CHECK(large.max_triangles == std::numeric_limits<int>::max());
}

TEST_CASE("an overload takes the budget into the band within some seconds, and it stays there") {
    for (const double rate_hz : {20.0, 60.0, 240.0}) {
        for (const double fixed_share : {0.0, 0.2, 0.4, 0.6}) {
            const StressSettings settings = settings_at(rate_hz);
            Machine machine;
            machine.fixed_ms = fixed_share * settings.target_frame_ms;
            machine.ms_per_triangle = (1.6 - fixed_share) * settings.target_frame_ms / 20000.0;
            StressState state = initial_state(20000.0, settings);
            const auto settle_frames = static_cast<std::size_t>(std::max(4.5 * rate_hz, 200.0));
            const auto targets = fly(state, settings, machine, static_cast<int>(settle_frames) * 5);
            INFO(rate_hz << " Hz, fixed share " << fixed_share);
            CHECK(std::is_sorted(targets.rbegin(), targets.rend())); // never turns back
            CHECK(all_same(targets, settle_frames));
            CHECK(stress_of(machine, settings, state) <= settings.max_stress);
            CHECK(stress_of(machine, settings, state) >= settings.min_stress);
        }
    }
}

TEST_CASE("noise moves no budget that has settled") {
    const StressSettings settings = settings_at(60.0);
    Machine machine{.fixed_ms = 5.0, .ms_per_triangle = 0.001, .noise = 0.15};
    StressState state = initial_state(20000.0, settings);
    CHECK(all_same(fly(state, settings, machine, 20000), 600));
    CHECK(stress_of(machine, settings, state) == Approx(0.825).margin(0.075));
}

TEST_CASE("violent noise makes a settled budget neither swing nor creep") {
    const StressSettings settings = settings_at(60.0);
    Machine machine{.fixed_ms = 5.0, .ms_per_triangle = 0.001, .noise = 0.35};
    StressState state = initial_state(20000.0, settings);
    fly(state, settings, machine, 600);
    const auto targets = fly(state, settings, machine, 20000);
    int changes = 0;
    for (std::size_t i = 1; i < targets.size(); ++i) { changes += targets[i] != targets[i - 1] ? 1 : 0; }
    CHECK(changes < 200);
    CHECK(stress_of(machine, settings, state) == Approx(0.825).margin(0.075));
}

TEST_CASE("the budget rises slowly into free time and follows a load that comes and goes") {
    const StressSettings settings = settings_at(60.0);
    Machine machine{.fixed_ms = 2.0, .ms_per_triangle = 0.0004, .noise = 0.05};
    StressState state = initial_state(20000.0, settings);
    const auto rising = fly(state, settings, machine, 900);
    CHECK(rising.back() > 25000);
    CHECK(all_same(rising, 600));
    const double before = state.target;
    machine.ms_per_triangle *= 2.0;
    const auto falling = fly(state, settings, machine, 900);
    CHECK(falling.back() < 0.7 * before);
    CHECK(falling[120] < 0.8 * before); // most of it within two seconds
    CHECK(all_same(falling, 300));
    machine.ms_per_triangle *= 0.5;
    const auto rising_again = fly(state, settings, machine, 1200);
    CHECK(rising_again.back() == Approx(before).epsilon(0.1));
    CHECK(all_same(rising_again, 900));
}

TEST_CASE("one slow frame moves a settled budget hardly or not at all") {
    for (const double rate_hz : {20.0, 60.0, 240.0}) {
        const StressSettings settings = settings_at(rate_hz);
        Machine machine;
        machine.fixed_ms = 0.3 * settings.target_frame_ms;
        for (const double stress : {0.76, 0.82, 0.89}) {
            machine.ms_per_triangle = (stress - 0.3) * settings.target_frame_ms / 20000.0;
            StressState state = initial_state(20000.0, settings);
            fly(state, settings, machine, 2000);
            REQUIRE(state.triangles() == 20000);
            state = next_state(state, settings, {20.0 * settings.target_frame_ms, 20000});
            fly(state, settings, machine, 2000);
            INFO(rate_hz << " Hz, stress " << stress);
            CHECK(state.triangles() <= 20000);
            CHECK(state.triangles() >= (stress < 0.85 && rate_hz >= 60.0 ? 20000 : 16000));
        }
    }
}

TEST_CASE("a machine that is too slow for the least budget holds it, and recovers") {
    const StressSettings settings = settings_at(60.0);
    Machine machine{.fixed_ms = 30.0, .ms_per_triangle = 0.001, .noise = 0.1};
    StressState state = initial_state(20000.0, settings);
    const auto targets = fly(state, settings, machine, 1000);
    CHECK(all_same(targets, 200));
    CHECK(targets.back() == 2500);
    machine.fixed_ms = 3.0;
    const auto recovered = fly(state, settings, machine, 1500);
    CHECK(recovered.back() > 8000);
    CHECK(all_same(recovered, 1000));
}

TEST_CASE("an idle machine is given the greatest budget and no more") {
    const StressSettings settings = settings_at(60.0, 1000);
    Machine machine{.fixed_ms = 0.5, .ms_per_triangle = 1e-6};
    StressState state = initial_state(1000.0, settings);
    fly(state, settings, machine, 1000);
    CHECK(state.triangles() == 4000);
}

TEST_CASE("a budget that the ground does not use is not raised") {
    const StressSettings settings = settings_at(60.0);
    StressState state = initial_state(20000.0, settings);
    for (int frame = 0; frame < 500; ++frame) { state = next_state(state, settings, {2.0, 6000}); }
    CHECK(state.triangles() == 20000);
    CHECK(state.trend == StressState::Trend::Held);
    CHECK(state.stress == Approx(2.0 / settings.target_frame_ms));
}

TEST_CASE("the stress is none before a frame is measured and the filtered share afterwards") {
    const StressSettings settings = settings_at(60.0);
    StressState state = initial_state(20000.0, settings);
    CHECK_FALSE(state.stress.has_value());
    state = next_state(state, settings, {0.85 * settings.target_frame_ms, 20000});
    CHECK(state.stress == Approx(0.85));
    state = next_state(state, settings, {3.85 * settings.target_frame_ms, 20000});
    CHECK(state.stress == Approx(0.85 + (1.0 - std::exp(-1.0 / 30.0)) * 3.0));
    const StressState other = with_target(state, 10000);
    CHECK(other.triangles() == 10000);
    CHECK(other.stress == state.stress);
    CHECK(other.expected_stress == Approx(state.expected_stress * 10000.0 / state.target));
}

TEST_CASE("whatever frames take, the budget changes in small steps within its limits") {
    RandomGenerator dice(11);
    for (int run = 0; run < 50; ++run) {
        const StressSettings settings = settings_at(dice.between(1.0, 1000.0));
        StressState state = initial_state(dice.between(100.0, 1e6), settings);
        Machine machine{.fixed_ms = settings.target_frame_ms * dice.between(0.0, 2.0),
            .ms_per_triangle = settings.target_frame_ms * dice.between(0.0, 1e-4),
            .noise = 0.9};
        fly(state, settings, machine, 500);
    }
}
