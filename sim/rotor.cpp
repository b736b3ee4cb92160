// Sources, all public:
// - 1,361 kg at most, 8.6 m/s of climb, 152 kt, five blades: data sheets of the 500MD. 420 shp of
// the
//   Allison 250-C20B, 375 shp through the gearbox: heli-archive.ch, "Hughes 500D".
// - Rotor 8.05 m across, blades 0.171 m deep, tips at 203 m/s (482 rpm): general knowledge of the
//   369D, not read in a source.
// - Thrust by blade elements, downwash by Glauert's momentum theory, induced and profile power: any
//   text on rotors, e.g. Leishman, Principles of Helicopter Aerodynamics, chapters 2, 3 and 5.
// Deviations: untwisted blades whose pitch is that at three quarters of the radius; lowest collective is no pitch, so
// that the rotor cannot do work on the aircraft then. Rotor speed never changes. No vortex ring. Power losses are
// chosen so that the published climb and speed come out.

#include "sim/rotor.h"

#include "sim/base/units.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::sim::md500 {

namespace {

constexpr double radius_m = 4.025;
constexpr double disc_m2 = pi * radius_m * radius_m;
constexpr double tip_mps = 203.0;
constexpr double solidity = 5.0 * 0.171 / (pi * radius_m);
constexpr double lift_slope = 5.7; // lift of a blade section per radian
constexpr double blade_drag = 0.010;
constexpr double max_pitch_rad = 0.22;
constexpr double induced_loss = 1.15;
constexpr double shaft_w = 375.0 * 745.7;
constexpr double engine_w = 420.0 * 745.7;
/// What the tail rotor, gears and fans leave of the engine's power.
constexpr double rotor_share = 0.845;

double pitch_share(double in_plane_mps) {
    const double advance = in_plane_mps / tip_mps;
    return 1.0 / 3.0 + 0.5 * advance * advance;
}

double thrust_scale_n(const Air& air) {
    return air.density_kgpm3 * disc_m2 * tip_mps * tip_mps * 0.5 * solidity * lift_slope;
}

double profile_w(double in_plane_mps, const Air& air) {
    const double advance = in_plane_mps / tip_mps;
    return air.density_kgpm3 * disc_m2 * tip_mps * tip_mps * tip_mps * solidity * blade_drag / 8.0 *
           (1.0 + 4.65 * advance * advance);
}

} // namespace

double blade_thrust_n(double collective, const RotorFlow& flow, const Air& air) {
    const double inflow = (flow.axial_mps + flow.induced_mps) / tip_mps;
    return thrust_scale_n(air) * (collective * max_pitch_rad * pitch_share(flow.in_plane_mps) - 0.5 * inflow);
}

double collective_for_thrust(double newtons, const RotorFlow& flow, const Air& air) {
    const double inflow = (flow.axial_mps + flow.induced_mps) / tip_mps;
    return (newtons / thrust_scale_n(air) + 0.5 * inflow) / (max_pitch_rad * pitch_share(flow.in_plane_mps));
}

double max_powered_thrust_n(const RotorFlow& flow, const Air& air) {
    const double power_w =
        rotor_share * std::min(shaft_w, engine_w * air.density_kgpm3 / standard_air(0.0).density_kgpm3);
    const double per_newton_mps = induced_loss * flow.induced_mps + flow.axial_mps;
    const double left_w = std::max(0.0, power_w - profile_w(flow.in_plane_mps, air));
    return per_newton_mps > 1e-3 ? left_w / per_newton_mps : std::numeric_limits<double>::infinity();
}

double steady_induced_mps(double newtons, const RotorFlow& flow, const Air& air) {
    const double hover2 = std::max(0.0, newtons) / (2.0 * air.density_kgpm3 * disc_m2);
    const double axial_mps = flow.axial_mps + flow.induced_mps;
    // Where the rotor sinks into its own wake momentum theory has no answer.
    const double min_mps = 0.5 * std::sqrt(hover2);
    const double wind_mps = std::max(std::hypot(flow.in_plane_mps, axial_mps), min_mps);
    return wind_mps > 0.0 ? hover2 / wind_mps : 0.0;
}

} // namespace octant::sim::md500
