#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/mesh_measurement.h"
#include "visuals/terrain/quadtree_control.h"
#include "visuals/terrain/quadtree_mesher.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;

namespace {

constexpr std::array gains = {0.5, 1.0, 2.0, 3.0, 4.0, 5.0};
constexpr std::array first_resolutions = {2.0, 4.0, 8.0, 16.0, 32.0, 64.0};
constexpr double weight = 5.0;

/// N of each frame of a standing view with N(C) = `count`.
template <typename Count>
std::vector<int> standing(const ControlSettings& settings, double first, int frames, const Count& count) {
    ControlState state = initial_state(first, settings);
    std::vector<int> all;
    for (int frame = 0; frame < frames; ++frame) {
        all.push_back(count(state.resolution));
        state = next_state(state, settings, all.back(), frame > 0);
    }
    return all;
}

/// From any C_0, at any gain, dn = 0 after at most 15 of 50 frames, `max_missing` from the target. `gained`: N'(C) at
/// the target; 0: by the automatic a.
template <typename Count>
void check_rest(int target, double gained, double max_missing, const Count& count) {
    for (const double gain : gains) {
        for (const double first : first_resolutions) {
            ControlSettings settings;
            settings.target_triangles = target;
            settings.triangles_per_resolution = gained / gain;
            settings.loop_gain = gain;
            const std::vector<int> all = standing(settings, first, 50, count);
            INFO("gain " << gain << ", C_0 " << first);
            CHECK(frames_until_constant(all, 10).value_or(50) <= 15);
            CHECK(std::abs(all.back() - target) <= max_missing);
        }
    }
}

Ground printed_ground(octant::models::heights::HeightField field) {
    return Ground(std::move(field), {.roughness = Roughness::Printed});
}

MeshView over(double angle) {
    return camera_view({70.0 * std::cos(angle), 70.0 * std::sin(angle), 15.0}, angle + 1.57, -0.2, 0.9);
}

double gained_from(Ground& ground, const MeshView& view, int target) {
    QuadtreeDetail detail{0.0, weight, FanKind::Partial};
    detail.resolution = resolution_for_target(ground.mesher, view, detail, target, 1000.0);
    return triangle_count_slope(ground.mesher, view, detail);
}

/// N along a slow arc.
std::vector<int> along_arc(Ground& ground, const ControlSettings& settings, double first) {
    ControlState state = initial_state(first, settings);
    std::vector<int> all;
    for (int frame = 0; frame < 200; ++frame) {
        const QuadtreeDetail detail{state.resolution, weight, FanKind::Partial};
        all.push_back(ground.mesher.mesh(over(0.0005 * frame), detail).counters.triangles);
        state = next_state(state, settings, all.back());
    }
    return all;
}

} // namespace

TEST_CASE("at a standing view the damped control rests within 15 frames, whatever the steps") {
    constexpr int target = 20000;
    for (const double exponent : {0.8, 1.0, 1.5, 2.0}) {
        for (const int step : {1, 50, 700, 3000}) { // the last two are beyond the dead band
            const auto count = [&](double resolution) {
                const double smooth = 1.01 * target * std::pow(resolution / 20.0, exponent);
                return step * static_cast<int>(smooth / step);
            };
            INFO("N ~ C^" << exponent << " in steps of " << step);
            const double band = std::max<double>(step, 0.005 * target);
            check_rest(target, 1.01 * target * exponent / 20.0, band, count);
            check_rest(target, 0.0, band, count);
        }
    }
}

TEST_CASE("at a standing view the damped control rests within 15 frames over any ground") {
    constexpr int target = 3000;
    for (const bool rugged : {false, true}) {
        Ground ground = printed_ground(rugged ? spiky_field(257, 257, 6) : rough_field(257, 257, 6));
        for (const double angle : {0.0, 3.0}) {
            INFO((rugged ? "rugged" : "gentle") << ", view " << angle);
            const MeshView view = over(angle);
            const auto count = [&](double resolution) {
                return ground.mesher.count(view, {resolution, weight, FanKind::Partial}).counters.triangles;
            };
            const double band = 0.01 * target; // steps of these fields stay below
            check_rest(target, gained_from(ground, view, target), band, count);
        }
    }
}

TEST_CASE("at a standing view the exact budget rests from the first frame on") {
    Ground ground = printed_ground(rough_field(257, 257, 6));
    std::vector<int> all;
    for (int frame = 0; frame < 10; ++frame) {
        all.push_back(
            ground.mesher.mesh_within(over(2.0), {0.0, weight, FanKind::Partial}, {3000, 500.0}).counters.triangles);
    }
    CHECK(frames_until_constant(all, 10) == 0);
}

TEST_CASE("a view that moves off after it stood is controlled as before") {
    ControlSettings settings;
    settings.triangles_per_resolution = 1000.0;
    const auto count = [](double resolution) { return 50.0 * std::floor(resolution * 20.0); };
    ControlState state = initial_state(50.0, settings);
    for (int frame = 0; frame < 20; ++frame) {
        state = next_state(state, settings, count(state.resolution), frame > 0);
    }
    const ControlState rested = state;
    CHECK(count(rested.resolution) == Approx(20000.0).epsilon(0.005));
    state = next_state(state, settings, 15000.0);
    CHECK(state.resolution == Approx(rested.resolution + 5.0 / 3.0)); // 5 / 15 of 5
}

TEST_CASE("where the gain is above 2 the damped control is 100 times as quiet along a path") {
    constexpr int target = 8000;
    Ground ground = printed_ground(rough_field(257, 257, 6));
    const double gained = gained_from(ground, over(0.05), target);
    for (const double gain : {3.0, 4.0}) {
        ControlSettings settings;
        settings.target_triangles = target;
        settings.triangles_per_resolution = gained / gain;
        settings.method = ControlMethod::Previous;
        const double previous = change_statistics(along_arc(ground, settings, 16.0), 50).mean;
        settings.method = ControlMethod::Damped;
        const double damped = change_statistics(along_arc(ground, settings, 16.0), 50).mean;
        INFO("gain " << gain << ": " << previous << " and " << damped);
        CHECK(previous > 100.0 * damped);
    }
}

TEST_CASE("figures of a series are those counted by hand") {
    const std::vector<int> all = {100, 110, 104, 104, 107, 100, 100, 100};
    const ChangeStatistics figures = change_statistics(all, 1); // dn 10 -6 0 3 -7 0 0
    CHECK(figures.mean == Approx(26.0 / 7.0));
    CHECK(figures.largest == 10);
    CHECK(figures.flicker_triangles == Approx((6.0 + 3.0) / 7.0));
    CHECK(change_statistics(all, 5).largest == 7);
    CHECK(change_statistics(all, 8).mean == 0.0);
    CHECK(frames_until_constant(all, 3) == 5);
    CHECK_FALSE(frames_until_constant(all, 4));
    CHECK(frames_until_within(all, 100, 0.05, 2) == 2);
    CHECK_FALSE(frames_until_within(all, 200, 0.05, 1));
}
