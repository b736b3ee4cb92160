// Source: U.S. Standard Atmosphere, 1976 (NOAA-S/T 76-1562), table 4 and equations 33a and 33b; the same as the ICAO
// standard atmosphere (Doc 7488) to 32 km. Deviations: the air above 32 km keeps the temperature it has there.

#include "sim/atmosphere.h"

#include "sim/base/units.h"

#include <algorithm>
#include <cmath>

namespace octant::sim {

namespace {

constexpr double sea_level_k = 288.15;
constexpr double sea_level_kgpm3 = 1.225;
constexpr double sea_level_sound_mps = 340.294;
constexpr double gas_constant = 287.05287; // specific gas constant of air, J/(kg K)

struct Layer {
    double base_m;
    double base_k;
    double lapse_kpm;
    double base_pressure_ratio;
};

constexpr Layer layers[] = {{0.0, 288.15, -0.0065, 1.0}, {11000.0, 216.65, 0.0, 0.2233611},
    {20000.0, 216.65, 0.001, 0.05403295}, {32000.0, 228.65, 0.0, 0.008566678}};

const Layer& layer_of(double height_m) {
    const Layer* found = &layers[0];
    for (const Layer& layer : layers) { found = height_m >= layer.base_m ? &layer : found; }
    return *found;
}

} // namespace

Air standard_air(double height_m) {
    const double within_m = std::clamp(height_m, -2000.0, 80000.0);
    const Layer& layer = layer_of(within_m);
    const double above_m = within_m - layer.base_m;
    const double temperature_k = layer.base_k + layer.lapse_kpm * above_m;
    const double fall = layer.lapse_kpm == 0.0
                            ? std::exp(-gravity_mps2 * above_m / (gas_constant * layer.base_k))
                            : std::pow(layer.base_k / temperature_k, gravity_mps2 / (gas_constant * layer.lapse_kpm));
    Air air;
    air.pressure_ratio = layer.base_pressure_ratio * fall;
    air.temperature_ratio = temperature_k / sea_level_k;
    air.density_kgpm3 = sea_level_kgpm3 * air.pressure_ratio / air.temperature_ratio;
    air.speed_of_sound_mps = sea_level_sound_mps * std::sqrt(air.temperature_ratio);
    return air;
}

} // namespace octant::sim
