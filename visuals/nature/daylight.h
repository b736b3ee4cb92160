#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace octant::visuals::nature {

/// Light of the clear sky by direction, for one place of the sun.
class PerezSky {
public:
    /// `sun_elevation_rad` from 0 to half pi; turbidity from 2 (clear) to 10 (hazy).
    PerezSky(double sun_elevation_rad, double turbidity);

    /// Linear light in sRGB's primaries, parts at least 0, thousands of candela a square metre for the luminance.
    /// `elevation_rad` is that of the look (taken as slightly above the horizon where it is lower), `azimuth_rad` its
    /// angle from the sun along the horizon.
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

/// Where the sun stands, and the colour of the horizon under a sun of 35 degrees.
struct DaylightOptions {
    double sun_azimuth_rad = 0.0;           ///< clockwise from north
    double sun_elevation_rad = 0.6;         ///< taken as 0 where it is less
    glm::vec3 horizon{0.62F, 0.72F, 0.84F}; ///< display values
};

/// Colours of the sky, of the haze and of the light for one place of the sun, display values. Under a low sun sky and
/// light are darker and warmer, but less so than in nature: the eye adapts.
class Daylight {
public:
    explicit Daylight(const DaylightOptions& options);

    /// Unit vector, world axes.
    const glm::dvec3& to_sun() const { return to_sun_; }

    /// Unit vector along the ground towards the sun; 0 where it stands overhead.
    const glm::dvec2& horizontal_to_sun() const { return horizontal_to_sun_; }

    /// What a surface's own colour is multiplied by: light from everywhere, and from the sun times the cosine to it.
    const glm::vec3& ambient() const { return ambient_; }

    const glm::vec3& sunlight() const { return sunlight_; }

    /// The horizon and the haze before it, away from the sun and towards it; horizon() is in between.
    const glm::vec3& haze_away() const { return haze_away_; }

    const glm::vec3& haze_sunward() const { return haze_sunward_; }

    /// `cos_to_sun`: of the angle along the horizon to the sun.
    glm::vec3 horizon(double cos_to_sun) const;

    /// The sky without the sun's disc in a direction (unit, world axes) at or above the horizon.
    glm::vec3 sky(const glm::dvec3& direction) const;

    const glm::vec3& disc() const { return disc_; }

    /// What the sun's glare adds to the sky's colour so far from its middle.
    glm::vec3 glare(double from_sun_rad) const;

    static constexpr double disc_rad = 0.00465;  ///< half of what the sun's disc covers
    static constexpr double glare_rad = 0.41888; ///< nothing is added from here on

private:
    glm::vec3 perez(double elevation_rad, double azimuth_rad) const;

    PerezSky sky_;
    double sun_azimuth_rad_;
    glm::dvec3 to_sun_;
    glm::dvec2 horizontal_to_sun_{0.0};
    glm::dvec3 exposure_{1.0}; ///< of red, green and blue
    glm::vec3 ambient_{0.0F};
    glm::vec3 sunlight_{0.0F};
    glm::vec3 haze_away_{0.0F};
    glm::vec3 haze_sunward_{0.0F};
    glm::vec3 disc_{0.0F};
};

/// What a slightly rough sea shows of the sky and of the sun, by the direction in which it is seen.
class WaterReflection {
public:
    explicit WaterReflection(const Daylight& day);

    /// Display values of a place: `own` is what comes out of the water itself, `from_eye` the way from the eye to it,
    /// of any length, downwards.
    glm::vec3 shaded_colour(const glm::vec3& own, const glm::vec3& from_eye) const;

private:
    static constexpr std::size_t heights = 9; ///< of the sky, evenly in the sine of elevation

    glm::vec3 sky(const glm::vec3& direction) const;

    glm::vec3 to_sun_;
    glm::vec2 horizontal_to_sun_;
    glm::vec3 sun_;
    std::array<glm::vec3, heights> sky_away_{};
    std::array<glm::vec3, heights> sky_sunward_{};
};

} // namespace octant::visuals::nature
