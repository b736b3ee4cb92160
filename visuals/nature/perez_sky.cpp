// A. J. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999:
// appendix A.1 (attenuation of sunlight by molecules and aerosols) and A.2 (zenith values,
// coefficients of Perez's distribution F).
//
// Deviations: ozone, mixed gases and water vapour are left out of the sunlight; red, green and blue
// are attenuated as light of 610, 550 and 465 nm.
#include "visuals/nature/perez_sky.h"

#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::nature {

namespace {

constexpr double min_cos_zenith = 0.014; ///< F has no value at the horizon itself

double cubic(double t, double a, double b, double c, double d) {
    return ((a * t + b) * t + c) * t + d;
}

/// Y in kcd/m^2, x and y overhead; `s` is the sun's angle from the zenith.
glm::dvec3 zenith_values(double s, double turbidity) {
    const double t = turbidity;
    const double chi = (4.0 / 9.0 - t / 120.0) * (pi - 2.0 * s);
    return {
        (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192,
        t * t * cubic(s, 0.00166, -0.00375, 0.00209, 0.0) +
            t * cubic(s, -0.02903, 0.06377, -0.03202, 0.00394) +
            cubic(s, 0.11693, -0.21196, 0.06052, 0.25886),
        t * t * cubic(s, 0.00275, -0.00610, 0.00317, 0.0) +
            t * cubic(s, -0.04214, 0.08970, -0.04153, 0.00516) +
            cubic(s, 0.15346, -0.26756, 0.06670, 0.26688)};
}

std::array<std::array<double, 5>, 3> coefficients(double t) {
    return {{
        {0.1787 * t - 1.4630,
         -0.3554 * t + 0.4275,
         -0.0227 * t + 5.3251,
         0.1206 * t - 2.5771,
         -0.0670 * t + 0.3703},
        {-0.0193 * t - 0.2592,
         -0.0665 * t + 0.0008,
         -0.0004 * t + 0.2125,
         -0.0641 * t - 0.8989,
         -0.0033 * t + 0.0452},
        {-0.0167 * t - 0.2608,
         -0.0950 * t + 0.0092,
         -0.0079 * t + 0.2102,
         -0.0441 * t - 1.6537,
         -0.0109 * t + 0.0529},
    }};
}

} // namespace

double PerezSky::Distribution::at(double cos_zenith, double angle_to_sun_rad) const {
    const auto& [a, b, c, d, e] = coefficient;
    const double cos_to_sun = std::cos(angle_to_sun_rad);
    return scale * (1.0 + a * std::exp(b / cos_zenith)) *
           (1.0 + c * std::exp(d * angle_to_sun_rad) + e * cos_to_sun * cos_to_sun);
}

PerezSky::PerezSky(double sun_elevation_rad, double turbidity)
    : sun_elevation_rad_(sun_elevation_rad) {
    const double from_zenith_rad = pi / 2.0 - sun_elevation_rad;
    const glm::dvec3 zenith = zenith_values(from_zenith_rad, turbidity);
    const auto all = coefficients(turbidity);
    for (std::size_t i = 0; i < distributions_.size(); ++i) {
        Distribution& own = distributions_[i];
        own = {all[i], 1.0};
        own.scale = zenith[static_cast<int>(i)] / own.at(1.0, from_zenith_rad);
    }
}

glm::dvec3 PerezSky::light(double elevation_rad, double azimuth_rad) const {
    const double cos_zenith = std::max(std::sin(elevation_rad), min_cos_zenith);
    const double cos_to_sun =
        std::sin(elevation_rad) * std::sin(sun_elevation_rad_) +
        std::cos(elevation_rad) * std::cos(sun_elevation_rad_) * std::cos(azimuth_rad);
    const double angle_rad = std::acos(std::clamp(cos_to_sun, -1.0, 1.0));
    const double luminance = distributions_[0].at(cos_zenith, angle_rad);
    const double x = distributions_[1].at(cos_zenith, angle_rad);
    const double y = distributions_[2].at(cos_zenith, angle_rad);
    const double big_x = x / y * luminance;
    const double big_z = (1.0 - x - y) / y * luminance;
    return glm::max(
        glm::dvec3(
            3.2406 * big_x - 1.5372 * luminance - 0.4986 * big_z,
            -0.9689 * big_x + 1.8758 * luminance + 0.0415 * big_z,
            0.0557 * big_x - 0.2040 * luminance + 1.0570 * big_z),
        glm::dvec3(0.0));
}

glm::dvec3 sunlight_transmittance(double sun_elevation_rad, double turbidity) {
    const double elevation_deg = deg_from_rad(sun_elevation_rad);
    const double air_mass =
        1.0 / (std::sin(sun_elevation_rad) + 0.15 * std::pow(elevation_deg + 3.885, -1.253));
    const double aerosol = 0.04608 * turbidity - 0.04586;
    glm::dvec3 left(0.0);
    constexpr std::array wavelength_um = {0.610, 0.550, 0.465};
    for (std::size_t i = 0; i < wavelength_um.size(); ++i) {
        const double depth = 0.008735 * std::pow(wavelength_um[i], -4.08) +
                             aerosol * std::pow(wavelength_um[i], -1.3);
        left[static_cast<int>(i)] = std::exp(-depth * air_mass);
    }
    return left;
}

} // namespace octant::visuals::nature
