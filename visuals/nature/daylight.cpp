#include "visuals/nature/daylight.h"

#include "models/material.h"
#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::nature {

// A. J. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999: appendix A.1
// (attenuation of sunlight by molecules and aerosols) and A.2 (zenith values, coefficients of Perez's distribution F).
//
// Deviations: ozone, mixed gases and water vapour are left out of the sunlight; red, green and blue are attenuated as
// light of 610, 550 and 465 nm. Under low suns the model's skies are lemon and green, and lilac away from the sun.
// There only its luminance is taken. The hue is the sunlight's own in a band above the horizon, wider and stronger
// towards the sun, where light has come a long way, and above it that of the sky under a higher sun.

namespace {

constexpr double min_cos_zenith = 0.014; ///< F has no value at the horizon itself

double cubic(double t, double a, double b, double c, double d) { return ((a * t + b) * t + c) * t + d; }

/// Y in kcd/m^2, x and y overhead; `s` is the sun's angle from the zenith.
glm::dvec3 zenith_values(double s, double turbidity) {
    const double t = turbidity;
    const double chi = (4.0 / 9.0 - t / 120.0) * (pi - 2.0 * s);
    return {(4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192,
        t * t * cubic(s, 0.00166, -0.00375, 0.00209, 0.0) + t * cubic(s, -0.02903, 0.06377, -0.03202, 0.00394) +
            cubic(s, 0.11693, -0.21196, 0.06052, 0.25886),
        t * t * cubic(s, 0.00275, -0.00610, 0.00317, 0.0) + t * cubic(s, -0.04214, 0.08970, -0.04153, 0.00516) +
            cubic(s, 0.15346, -0.26756, 0.06670, 0.26688)};
}

std::array<std::array<double, 5>, 3> coefficients(double t) {
    return {{
        {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771, -0.0670 * t + 0.3703},
        {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989, -0.0033 * t + 0.0452},
        {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537, -0.0109 * t + 0.0529},
    }};
}

} // namespace

double PerezSky::Distribution::at(double cos_zenith, double angle_to_sun_rad) const {
    const auto& [a, b, c, d, e] = coefficient;
    const double cos_to_sun = std::cos(angle_to_sun_rad);
    return scale * (1.0 + a * std::exp(b / cos_zenith)) *
           (1.0 + c * std::exp(d * angle_to_sun_rad) + e * cos_to_sun * cos_to_sun);
}

PerezSky::PerezSky(double sun_elevation_rad, double turbidity) : sun_elevation_rad_(sun_elevation_rad) {
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
    const double cos_to_sun = std::sin(elevation_rad) * std::sin(sun_elevation_rad_) +
                              std::cos(elevation_rad) * std::cos(sun_elevation_rad_) * std::cos(azimuth_rad);
    const double angle_rad = std::acos(std::clamp(cos_to_sun, -1.0, 1.0));
    const double luminance = distributions_[0].at(cos_zenith, angle_rad);
    const double x = distributions_[1].at(cos_zenith, angle_rad);
    const double y = distributions_[2].at(cos_zenith, angle_rad);
    const double big_x = x / y * luminance;
    const double big_z = (1.0 - x - y) / y * luminance;
    return glm::max(glm::dvec3(3.2406 * big_x - 1.5372 * luminance - 0.4986 * big_z,
                        -0.9689 * big_x + 1.8758 * luminance + 0.0415 * big_z,
                        0.0557 * big_x - 0.2040 * luminance + 1.0570 * big_z),
        glm::dvec3(0.0));
}

glm::dvec3 sunlight_transmittance(double sun_elevation_rad, double turbidity) {
    const double elevation_deg = deg_from_rad(sun_elevation_rad);
    const double air_mass = 1.0 / (std::sin(sun_elevation_rad) + 0.15 * std::pow(elevation_deg + 3.885, -1.253));
    const double aerosol = 0.04608 * turbidity - 0.04586;
    glm::dvec3 left(0.0);
    constexpr std::array wavelength_um = {0.610, 0.550, 0.465};
    for (std::size_t i = 0; i < wavelength_um.size(); ++i) {
        const double depth = 0.008735 * std::pow(wavelength_um[i], -4.08) + aerosol * std::pow(wavelength_um[i], -1.3);
        left[static_cast<int>(i)] = std::exp(-depth * air_mass);
    }
    return left;
}

namespace {

constexpr double turbidity = 2.6;
constexpr double usual_elevation_rad = rad_from_deg(35.0); ///< under which colours are as given
constexpr double low_elevation_rad = rad_from_deg(25.0);   ///< lower suns make the light warm
constexpr double reddest_rad = rad_from_deg(2.5);          ///< suns below it are not redder
constexpr double horizon_rad = rad_from_deg(1.0);
constexpr double horizon_blend_rad = rad_from_deg(4.0);
const glm::dvec3 usual_horizon(0.62, 0.72, 0.84); ///< under which the light is as given
const glm::dvec3 weights(0.2126, 0.7152, 0.0722); ///< luminance of linear sRGB

// Light on the ground under the usual sun, and the factors that the camera's exposure leaves under a sun at the
// horizon.
const glm::vec3 usual_ambient(0.39F, 0.42F, 0.47F);
const glm::vec3 usual_sunlight(0.80F, 0.78F, 0.74F);
constexpr double low_ambient = 1.50;
constexpr double ambient_power = 0.7; ///< of lowness: level ground gets darker all the way to the horizon
constexpr double low_horizon = 0.66;  ///< of luminance
/// Exposure makes up for so much of lost sunlight, in stops a stop, under a high sun and under one at the horizon.
constexpr double exposure_power = 0.60;
constexpr double low_exposure_power = 0.85;
constexpr double high_exposure_power = 0.35; ///< of light on level ground that exceeds the usual sun's
constexpr double low_saturation = 0.72;      ///< of the sunlight's hue, the rest is taken for white
constexpr double blue_saturation = 0.75;     ///< of the sky above the warm band
/// Of the mean of red and blue, under a high sun and under one at the horizon: less is lilac.
constexpr double min_green = 0.96;
constexpr double low_min_green = 1.02;

/// 1 for a sun at the horizon, 0 for one that is high.
double lowness_of(double sun_elevation_rad) {
    return 1.0 - glm::smoothstep(0.0, 1.0, sun_elevation_rad / low_elevation_rad);
}

glm::dvec3 hue_of(const glm::dvec3& light) { return light / std::max(glm::dot(light, weights), 1e-9); }

/// The sun's light over that under the usual sun.
glm::dvec3 sunlight_ratio(double sun_elevation_rad) {
    return sunlight_transmittance(sun_elevation_rad, turbidity) /
           sunlight_transmittance(usual_elevation_rad, turbidity);
}

/// The sunlight's hue as a camera balanced partly for it shows it. Light scattered more than once keeps it from turning
/// red at the horizon.
glm::dvec3 balanced_hue(double sun_elevation_rad) {
    const glm::dvec3 hue = hue_of(sunlight_ratio(std::max(sun_elevation_rad, reddest_rad)));
    return glm::mix(glm::dvec3(1.0), hue, glm::mix(1.0, low_saturation, lowness_of(sun_elevation_rad)));
}

/// The mean around the horizon, but for the side of the sun, of what `light` gives by azimuth.
template <typename Light>
glm::dvec3 mean_beside_sun(const Light& light) {
    glm::dvec3 sum(0.0);
    for (const double azimuth_deg : {60.0, 90.0, 120.0, 180.0}) { sum += 0.25 * light(rad_from_deg(azimuth_deg)); }
    return sum;
}

/// How much of the sunlight's hue the sky has in a direction under a sun at the horizon.
double warm_share(double elevation_rad, double azimuth_rad) {
    const double towards = 0.5 + 0.5 * std::cos(azimuth_rad);
    const double strength = 0.62 + 0.36 * towards * towards;
    const double height_rad = rad_from_deg(7.0 + 14.0 * towards * towards);
    return strength * std::exp(-elevation_rad / height_rad);
}

} // namespace

ExposedSky::ExposedSky(double sun_elevation_rad, const glm::dvec3& horizon)
    : sky_(sun_elevation_rad, turbidity), usual_(usual_elevation_rad, turbidity), low_(lowness_of(sun_elevation_rad)),
      sunlight_hue_(balanced_hue(sun_elevation_rad)) {
    const auto horizon_of = [](const PerezSky& sky) {
        return mean_beside_sun([&](double azimuth_rad) { return sky.light(horizon_rad, azimuth_rad); });
    };
    const glm::dvec3 aim = -glm::log(1.0 - glm::min(models::linear_from_srgb(horizon), glm::dvec3(0.98)));
    const glm::dvec3 usual_exposure = aim / horizon_of(usual_);
    const double wanted = glm::dot(aim, weights) * glm::mix(1.0, low_horizon, low_ * low_);
    const glm::dvec3 found = horizon_of(sky_);
    exposure_ = usual_exposure * (wanted / std::max(glm::dot(usual_exposure * found, weights), 1e-6));
    low_exposure_ = wanted / std::max(glm::dot(found, weights), 1e-6);
}

glm::dvec3 ExposedSky::light(double elevation_rad, double azimuth_rad) const {
    const glm::dvec3 model = sky_.light(elevation_rad, azimuth_rad);
    if (low_ <= 0.0) { return exposure_ * model; }
    const glm::dvec3 blue =
        glm::mix(glm::dvec3(1.0), hue_of(exposure_ * usual_.light(elevation_rad, 0.5 * pi)), blue_saturation);
    glm::dvec3 hue = glm::mix(blue, sunlight_hue_, warm_share(elevation_rad, azimuth_rad));
    hue.y = std::max(hue.y, std::sqrt(hue.x * hue.z)); // less is lilac, between blue and orange
    return glm::mix(exposure_ * model, low_exposure_ * glm::dot(model, weights) * hue, low_);
}

glm::dvec3 ExposedSky::horizon_light() const {
    return mean_beside_sun([&](double azimuth_rad) { return light(horizon_rad, azimuth_rad); });
}

namespace {

glm::dvec3 power_of(const glm::dvec3& light) { return glm::pow(light, glm::dvec3(1.0 / 2.2)); }

/// The sun's colour over its colour at the usual height, display values.
glm::dvec3 sunlight_share(double elevation_rad) {
    const glm::dvec3 ratio = sunlight_ratio(elevation_rad);
    const double left = 1.0 - glm::mix(exposure_power, low_exposure_power, lowness_of(elevation_rad));
    return power_of(balanced_hue(elevation_rad) * std::pow(glm::dot(ratio, weights), left));
}

/// Mean colour of the whole sky as level ground sees it, its parts' mean being 1.
glm::dvec3 sky_tint(const ExposedSky& sky) {
    glm::dvec3 sum(0.0);
    for (const double elevation_deg : {10.0, 30.0, 60.0}) {
        const double elevation_rad = rad_from_deg(elevation_deg);
        for (int i = 0; i < 8; ++i) {
            sum += std::sin(2.0 * elevation_rad) * power_of(sky.light(elevation_rad, pi / 4.0 * i));
        }
    }
    return sum * (3.0 / (sum.x + sum.y + sum.z));
}

/// Green: near the luminance.
float light_on_level(const glm::vec3& ambient, const glm::vec3& sunlight, double sun_elevation_rad) {
    return ambient.y + sunlight.y * static_cast<float>(std::sin(sun_elevation_rad));
}

} // namespace

Daylight::Daylight(const DaylightOptions& options)
    : sky_(std::max(options.sun_elevation_rad, 0.0), glm::dvec3(options.horizon)) {
    if (options.dust) {
        const glm::dvec3 tint = glm::sqrt(models::linear_from_srgb(glm::dvec3(*options.dust)));
        air_tint_ = tint / glm::dot(tint, weights);
    }
    const double elevation_rad = std::max(options.sun_elevation_rad, 0.0);
    const glm::dvec2 level(std::sin(options.sun_azimuth_rad), std::cos(options.sun_azimuth_rad));
    to_sun_ = {std::cos(elevation_rad) * level.x, std::cos(elevation_rad) * level.y, std::sin(elevation_rad)};
    horizontal_to_sun_ = level;
    haze_away_ = displayed(sky_.horizon_light());
    haze_sunward_ = displayed(sky_.light(horizon_rad, 0.0));
    const double low = lowness_of(elevation_rad);
    const glm::dvec3 tint =
        sky_tint(ExposedSky(elevation_rad, usual_horizon)) / sky_tint(ExposedSky(usual_elevation_rad, usual_horizon));
    // The camera takes half of the light's own colour for white.
    ambient_ = usual_ambient * glm::vec3(glm::sqrt(tint) * glm::mix(1.0, low_ambient, std::pow(low, ambient_power)));
    const auto least_green = static_cast<float>(glm::mix(min_green, low_min_green, low));
    ambient_.y = std::max(ambient_.y, least_green * 0.5F * (ambient_.x + ambient_.z));
    const glm::dvec3 share = sunlight_share(elevation_rad);
    sunlight_ = usual_sunlight * glm::vec3(glm::min(share, glm::dvec3(1.15)));
    const glm::dvec3 pure = share / std::max({share.x, share.y, share.z});
    const float level_light = light_on_level(ambient_, sunlight_, elevation_rad);
    const float usual_light = light_on_level(usual_ambient, usual_sunlight, usual_elevation_rad);
    if (level_light > usual_light) {
        const float exposure = std::pow(usual_light / level_light, static_cast<float>(high_exposure_power));
        ambient_ *= exposure;
        sunlight_ *= exposure;
    }
    disc_ = glm::vec3(glm::mix(pure, glm::dvec3(1.0), glm::mix(0.5, 0.95, std::sqrt(1.0 - low))));
}

glm::vec3 Daylight::displayed(const glm::dvec3& exposed) const {
    const glm::dvec3 light = air_tint_ ? glm::dot(exposed, weights) * *air_tint_ : exposed;
    return glm::vec3(models::srgb_from_linear(1.0 - glm::exp(-light)));
}

glm::vec3 Daylight::horizon(double cos_to_sun) const {
    const auto towards = static_cast<float>(std::max(cos_to_sun, 0.0));
    return glm::mix(haze_away_, haze_sunward_, towards * towards);
}

glm::vec3 Daylight::sky(const glm::dvec3& direction) const {
    const double elevation_rad = std::asin(std::clamp(direction.z, 0.0, 1.0));
    const double level = std::max(glm::length(glm::dvec2(direction)), 1e-9);
    const double cos_to_sun = glm::dot(glm::dvec2(direction), horizontal_to_sun_) / level;
    const glm::vec3 high = displayed(sky_.light(elevation_rad, std::acos(std::clamp(cos_to_sun, -1.0, 1.0))));
    const auto share = static_cast<float>(glm::smoothstep(0.0, 1.0, elevation_rad / horizon_blend_rad));
    return glm::mix(horizon(cos_to_sun), high, share);
}

glm::vec3 Daylight::glare(double from_sun_rad) const {
    const double left = 1.0 - glm::smoothstep(0.0, 1.0, from_sun_rad / glare_rad);
    const double size = left * (0.45 * std::exp(-from_sun_rad / rad_from_deg(1.0)) +
                                   0.12 * std::exp(-from_sun_rad / rad_from_deg(7.0)));
    return disc_ * static_cast<float>(size);
}

// Reflection by angle: C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering",
// 1994. The sun's glitter: facets whose slopes are spread as C. Cox and W. Munk measured them,
// "Measurement of the Roughness of the Sea Surface from Photographs of the Sun's Glitter", 1954, for a light wind.

namespace {

constexpr float straight_down = 0.02F; ///< share of light that is reflected
constexpr float slope_variance = 0.02F;
/// Waves that face the eye hide those behind: at grazing angles less is reflected than off glass.
constexpr float max_reflected = 0.75F;
constexpr float glitter = 0.9F; ///< of the sun's colour in the middle of its path
/// Least half width of the sun's path as seen, radians: colours are known at corners of triangles half as wide. A wider
/// path is as much fainter.
constexpr float min_path_rad = 0.20F;
constexpr float usual_reflected = 0.085F; ///< of sunlight by a facet, under the usual sun

float reflected_share(float cos_incidence, float most) {
    const float left = 1.0F - cos_incidence;
    return straight_down + (most - straight_down) * left * left * left * left * left;
}

} // namespace

WaterReflection::WaterReflection(const Daylight& day)
    : to_sun_(day.to_sun()), horizontal_to_sun_(day.horizontal_to_sun()), sun_(day.disc()) {
    const glm::dvec2 sunward =
        glm::length(day.horizontal_to_sun()) > 0.0 ? day.horizontal_to_sun() : glm::dvec2(1.0, 0.0);
    for (std::size_t i = 0; i < heights; ++i) {
        const double up = static_cast<double>(i) / (heights - 1);
        const double level = std::sqrt(1.0 - up * up);
        sky_sunward_[i] = day.sky(glm::dvec3(sunward * level, up));
        sky_away_[i] = day.sky(glm::dvec3(-sunward * level, up));
    }
}

glm::vec3 WaterReflection::sky(const glm::vec3& direction) const {
    const float place = std::clamp(direction.z, 0.0F, 1.0F) * (heights - 1);
    const auto low = std::min(static_cast<std::size_t>(place), heights - 2);
    const float part = place - static_cast<float>(low);
    const float towards = std::max(glm::dot(glm::vec2(direction), horizontal_to_sun_), 0.0F);
    return glm::mix(glm::mix(sky_away_[low], sky_away_[low + 1], part),
        glm::mix(sky_sunward_[low], sky_sunward_[low + 1], part), towards * towards);
}

float WaterReflection::glitter_towards(const glm::vec3& way) const {
    const glm::vec3 facet = to_sun_ - way;
    const float along = glm::dot(glm::vec2(facet), horizontal_to_sun_);
    const float across2 = facet.x * facet.x + facet.y * facet.y - along * along;
    const float least = min_path_rad / std::max(facet.z, min_path_rad);
    const float variance = std::max(slope_variance, least * least);
    const float slopes = (along * along / slope_variance + across2 / variance) / std::max(facet.z * facet.z, 1e-6F);
    const float cos_incidence = std::sqrt(std::max(0.5F - 0.5F * glm::dot(way, to_sun_), 0.0F));
    const float reflected = std::max(reflected_share(cos_incidence, 1.0F), usual_reflected) / usual_reflected;
    return std::exp(-slopes) * glitter * std::sqrt(reflected * slope_variance / variance);
}

glm::vec3 WaterReflection::shaded_colour(const glm::vec3& own, const glm::vec3& from_eye) const {
    const glm::vec3 way = glm::normalize(from_eye);
    const float down = std::clamp(-way.z, 0.0F, 1.0F);
    const glm::vec3 colour =
        glm::mix(own, sky({way.x, way.y, std::max(-way.z, 0.02F)}), reflected_share(down, max_reflected));
    return glm::min(colour + sun_ * glitter_towards(way), glm::vec3(1.0F));
}

} // namespace octant::visuals::nature
