#include "flightpaths/fly_script.h"
#include "sim/aircraft_kind.h"
#include "tests/fuzz/formats/target.h"

#include <cmath>

namespace octant::tests::formats::path_script_format {

namespace {

constexpr int max_steps = 20000;

/// Flies it where that does not take long, within limits and with legs clipped.
void use(const std::filesystem::path& file) {
    const flightpaths::PathScript script = flightpaths::read_path_script(file);
    const sim::AircraftKind* const kind = sim::find_aircraft_kind(script.aircraft);
    if (kind == nullptr || script.samples > max_steps / 120 * script.rate_hz) { return; }
    const flightpaths::FlownPath flown = flightpaths::fly(script, *kind, true);
    for (const sim::AircraftState& state : flown.trajectory.samples()) {
        for (int part = 0; part < 3; ++part) {
            expect(std::isfinite(state.position_m[part]), "a place");
            expect(std::isfinite(state.velocity_mps[part]), "a velocity");
        }
        expect(std::abs(glm::length(state.body_to_world) - 1.0) < 1e-6, "a unit attitude");
    }
}

constexpr const char* all_kinds = R"(aircraft = "f15"
title = "all kinds of legs"
rate_hz = 20
samples = 600
min_clearance_m = 280
angle_of_attack_deg_per_g = 1.2

[start]
north_m = -1500
east_m = 1500.5
height_m = 300
heading_deg = 0
speed_mps = 235

[[leg]]
fly = "straight"
duration_s = 3

[[leg]]
fly = "turn"
label = "left"
side = "left"
bank_deg = 60
heading_change_deg = 30
acceleration_mps2 = -0.3

[[leg]]
fly = "climb"
climb_deg = 10
to_height_m = 400

[[leg]]
fly = "jink"
duration_s = 4
lateral_g = 1.0
period_s = 2
vertical_g = 0.3
vertical_period_s = 2

[[leg]]
fly = "straight"
duration_s = 30
)";

constexpr const char* helicopter = R"(aircraft = "500md"
title = "helicopter"
rate_hz = 10
samples = 200
min_clearance_m = 20

[start]
north_m = 0
east_m = 0
height_m = 60
heading_deg = 90
speed_mps = 40

[[leg]]
fly = "hold"
duration_s = 25
)";

const Registered target({
    .name = "path_script",
    .file = "input.toml",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{all_kinds, helicopter};
        },
    .words = {"[[leg]]\n", "fly = ", "\"straight\"\n", "\"turn\"\n", "\"jink\"\n", "\"pull\"\n", "\"push\"\n",
        "\"dive\"\n", "\"hold\"\n", "load_factor_g = ", "climb_deg = ", "duration_s = ", "to_speed_mps = ", "[start]\n",
        "inf", "nan", "1979-05-27", "[1]", "true", "'''"},
});

} // namespace

} // namespace octant::tests::formats::path_script_format
