#pragma once

#include <glm/vec3.hpp>

#include <array>

namespace octant::visuals::nature {

/// Light of the clear sky by direction, for one place of the sun.
class PerezSky {
public:
    /// `sun_elevation_rad` from 0 to half pi; turbidity from 2 (clear) to 10 (hazy).
    PerezSky(double sun_elevation_rad, double turbidity);

    /// Linear light in sRGB's primaries, parts at least 0, thousands of candela a square metre for
    /// the luminance. `elevation_rad` is that of the look (taken as slightly above the horizon
    /// where it is lower), `azimuth_rad` its angle from the sun along the horizon.
    glm::dvec3 light(double elevation_rad, double azimuth_rad) const;

private:
    /// Of one of Y, x and y: Perez's five coefficients, then the value overhead over F there.
    struct Distribution {
        std::array<double, 5> coefficient{};
        double scale = 0.0;

        double at(double cos_zenith, double angle_to_sun_rad) const;
    };

    double sun_elevation_rad_;
    std::array<Distribution, 3> distributions_; ///< of Y, x and y
};

/// Share of the sun's light beyond the air that reaches the ground, red, green and blue.
glm::dvec3 sunlight_transmittance(double sun_elevation_rad, double turbidity);

} // namespace octant::visuals::nature
