#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/quadtree_control.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace octant::visuals::terrain;

namespace {

constexpr double target = 20000.0;

/// 1000 triangles per unit of C, in steps of 50.
double staircase(double resolution) { return 50.0 * std::floor(resolution * 20.0); }

ControlSettings with_gain(ControlMethod method, double gain) {
    ControlSettings settings;
    settings.method = method;
    settings.target_triangles = target;
    settings.triangles_per_resolution = 1000.0 / gain;
    return settings;
}

/// N of each frame at a fixed view with N(C) = `count`.
template <typename Count>
std::vector<double> counts(const ControlSettings& settings, double first, int frames, Count count) {
    ControlState state = initial_state(first, settings);
    std::vector<double> all;
    for (int frame = 0; frame < frames; ++frame) {
        all.push_back(count(state.resolution));
        state = next_state(state, settings, all.back());
    }
    return all;
}

/// Mean |N - N of the frame before| over the last 50 frames of 400, from C = 16.
double ripple(const ControlSettings& settings) {
    const std::vector<double> all = counts(settings, 16.0, 400, staircase);
    double sum = 0.0;
    for (std::size_t k = all.size() - 50; k < all.size(); ++k) { sum += std::abs(all[k] - all[k - 1]); }
    return sum / 50.0;
}

} // namespace

TEST_CASE("equation (4) moves C by the missing triangles over a") {
    const ControlSettings settings = with_gain(ControlMethod::Previous, 1.0);
    const ControlState state = next_state(initial_state(10.0, settings), settings, 15000.0);
    CHECK(state.resolution == Approx(15.0));
    CHECK(next_state(state, settings, 23000.0).resolution == Approx(12.0));
}

TEST_CASE("equation (5) weighs the last five results of (4) with 5, 4, 3, 2, 1") {
    const ControlSettings settings = with_gain(ControlMethod::Damped, 1.0);
    ControlState state = next_state(initial_state(10.0, settings), settings, 15000.0); // (4): 15
    CHECK(state.resolution == Approx((5.0 * 15.0 + 10.0 * 10.0) / 15.0));
    const double second = state.resolution + 2.0;
    state = next_state(state, settings, 18000.0);
    CHECK(state.resolution == Approx((5.0 * second + 4.0 * 15.0 + 6.0 * 10.0) / 15.0));
    const double third = state.resolution + 1.0;
    state = next_state(state, settings, 19000.0);
    CHECK(state.resolution == Approx((5.0 * third + 4.0 * second + 3.0 * 15.0 + 3.0 * 10.0) / 15.0));
}

TEST_CASE("without remembered frames the damped control is the previous one") {
    ControlSettings damped = with_gain(ControlMethod::Damped, 1.7);
    damped.averaged_frames = 0;
    damped.dead_band = 0.0;
    const ControlSettings previous = with_gain(ControlMethod::Previous, 1.7);
    CHECK(counts(damped, 5.0, 100, staircase) == counts(previous, 5.0, 100, staircase));
}

TEST_CASE("the literal reading follows the change of N and knows no target") {
    ControlSettings settings = with_gain(ControlMethod::Printed, 1.0);
    ControlState state = next_state(initial_state(16.0, settings), settings, 4000.0);
    CHECK(state.resolution == Approx(12.0)); // N was 0 before the first frame
    state = next_state(state, settings, 1000.0);
    CHECK(state.resolution == Approx(15.0));
    CHECK(next_state(state, settings, 1000.0).resolution == Approx(15.0));
}

TEST_CASE("C stays within its limits") {
    for (const ControlMethod method : {ControlMethod::Previous, ControlMethod::Damped, ControlMethod::Printed}) {
        ControlSettings settings = with_gain(method, 1.0);
        settings.max_resolution = 30.0;
        CHECK(initial_state(100.0, settings).resolution == 30.0);
        CHECK(initial_state(0.0, settings).resolution == 2.0);
        ControlState state = initial_state(29.0, settings);
        for (int frame = 0; frame < 20; ++frame) {
            state = next_state(state, settings, frame % 2 == 0 ? 1e6 : 0.0);
            CHECK(state.resolution >= 2.0);
            CHECK(state.resolution <= 30.0);
        }
    }
}

TEST_CASE("within the dead band C stays and the past is forgotten") {
    const ControlSettings settings = with_gain(ControlMethod::Damped, 1.0);
    ControlState state = next_state(initial_state(10.0, settings), settings, 15000.0);
    const double kept = state.resolution;
    state = next_state(state, settings, 20090.0);
    CHECK(state.resolution == kept);
    state = next_state(state, settings, 20101.0);
    CHECK(state.resolution == Approx((5.0 * (kept - 0.101) + 10.0 * kept) / 15.0));
}

TEST_CASE("the previous control settles up to a loop gain of 2 and oscillates for ever above") {
    CHECK(ripple(with_gain(ControlMethod::Previous, 0.5)) == 0.0);
    CHECK(ripple(with_gain(ControlMethod::Previous, 1.5)) <= 100.0); // two steps of N(C)
    CHECK(ripple(with_gain(ControlMethod::Previous, 2.5)) > 5000.0);
    CHECK(ripple(with_gain(ControlMethod::Previous, 5.0)) > 20000.0);
}

TEST_CASE("the previous control below a loop gain of 1 approaches from one side") {
    const std::vector<double> all = counts(with_gain(ControlMethod::Previous, 0.5), 5.0, 50, staircase);
    CHECK(std::is_sorted(all.begin(), all.end()));
    CHECK(all.back() == Approx(target).epsilon(0.005));
}

TEST_CASE("the damped control settles where the previous one oscillates") {
    for (const double gain : {0.5, 1.5, 2.5, 4.0, 5.0}) {
        const ControlSettings settings = with_gain(ControlMethod::Damped, gain);
        CHECK(ripple(settings) == 0.0);
        CHECK(counts(settings, 16.0, 400, staircase).back() == Approx(target).epsilon(0.005));
    }
    CHECK(ripple(with_gain(ControlMethod::Damped, 7.0)) > 5000.0);
}

TEST_CASE("an automatic a reaches the target however N grows with C") {
    for (const ControlMethod method : {ControlMethod::Previous, ControlMethod::Damped}) {
        for (const double exponent : {0.8, 1.2, 1.6, 2.0}) {
            for (const double first : {2.0, 16.0, 500.0}) {
                ControlSettings settings;
                settings.method = method;
                settings.target_triangles = target;
                const auto grows = [&](double resolution) {
                    return std::floor(target * std::pow(resolution / 20.0, exponent));
                };
                const std::vector<double> all = counts(settings, first, 80, grows);
                CHECK(all.back() == Approx(target).epsilon(0.005));
                CHECK(all.back() == all[all.size() - 2]);
            }
        }
    }
}

namespace {

CountedMesh counted(double triangles) { return {.counters = {.triangles = static_cast<int>(triangles)}}; }

} // namespace

TEST_CASE("with its own gain the control meets the target in every frame, however N grows") {
    ControlSettings settings;
    settings.method = ControlMethod::Tuned;
    settings.target_triangles = 32000.0;
    for (const double exponent : {0.6, 1.0, 1.5, 2.0, 2.6}) {
        INFO("exponent " << exponent);
        ControlState state = initial_state(16.0, settings);
        double changes = 0.0;
        double last = 0.0;
        int max_meshes = 0;
        for (int frame = 0; frame < 300; ++frame) {
            // The view alone changes N by one per cent to and fro.
            const double wave = 1.0 + 0.01 * std::sin(1.3 * frame) + 0.005 * std::sin(0.1 * frame);
            int meshes = 0;
            const auto make = [&](double resolution) {
                ++meshes;
                const double smooth = 900.0 * wave * std::pow(resolution, exponent);
                return counted(std::floor(smooth / 6.0) * 6.0);
            };
            const double triangles = controlled_mesh(state, settings, false, make).counters.triangles;
            changes += frame >= 20 ? std::abs(triangles - last) : 0.0;
            last = triangles;
            max_meshes = std::max(max_meshes, meshes);
        }
        CHECK(changes / 280.0 < 0.001 * settings.target_triangles);
        CHECK(max_meshes <= max_tuned_meshes);
        CHECK(state.exponent == Approx(exponent).epsilon(0.25));
    }
}

TEST_CASE("with its own gain the control stands still at a view that stands still") {
    ControlSettings settings;
    settings.method = ControlMethod::Tuned;
    settings.target_triangles = target;
    for (const double first : {2.0, 16.0, 500.0}) {
        ControlState state = initial_state(first, settings);
        std::vector<double> all;
        for (int frame = 0; frame < 120; ++frame) {
            const auto make = [](double resolution) { return counted(staircase(resolution)); };
            all.push_back(controlled_mesh(state, settings, frame > 0, make).counters.triangles);
        }
        CHECK(all.back() == Approx(target).epsilon(0.01));
        CHECK(std::all_of(all.end() - 100, all.end(), [&](double n) { return n == all.back(); }));
    }
}
