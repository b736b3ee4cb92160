#pragma once

namespace octant::sim {

/// Still air at one height of the ICAO standard atmosphere.
struct Air {
    double density_kgpm3 = 0.0;
    /// The speed of sound.
    double speed_of_sound_mps = 0.0;
    /// The pressure over that at sea level.
    double pressure_ratio = 0.0;
    /// The absolute temperature over that at sea level.
    double temperature_ratio = 0.0;
};

/// Air of a height above datum, taken as geopotential height above sea level. Heights below -2 km and above 80 km get
/// the air of those.
Air standard_air(double height_m);

} // namespace octant::sim
