#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>

namespace octant::visuals::nature {

/// Light of the clear sky by direction, for one position of the sun (Perez's model).
class PerezSky {
public:
    /// `sun_elevation_rad` from 0 to half pi; turbidity from 2 (clear) to 10 (hazy).
    PerezSky(double sun_elevation_rad, double turbidity);

    /// Linear light in sRGB's primaries, each at least 0, in thousands of candela a square metre. `elevation_rad`: of
    /// the direction of view, raised to slightly above the horizon if lower; `azimuth_rad`: its horizontal angle from
    /// the sun.
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

/// The share of sunlight that the air transmits to the ground: red, green and blue.
glm::dvec3 sunlight_transmittance(double sun_elevation_rad, double turbidity);

/// The clear sky as a camera records it that is exposed for the landscape.
class ExposedSky {
public:
    /// `horizon`: display colour of the horizon away from a sun of 35 degrees, by which the camera is set.
    ExposedSky(double sun_elevation_rad, const glm::dvec3& horizon);

    /// Linear light in a direction as PerezSky::light() takes it; a full exposure is 1 - exp(-light).
    glm::dvec3 light(double elevation_rad, double azimuth_rad) const;

    /// Its mean around the horizon, but for the side of the sun.
    glm::dvec3 horizon_light() const;

private:
    PerezSky sky_;
    PerezSky usual_;               ///< under a sun of 35 degrees
    glm::dvec3 exposure_{1.0};     ///< of red, green and blue
    double low_exposure_ = 1.0;    ///< of luminance, under a low sun
    double low_ = 0.0;             ///< 1 for a sun at the horizon, 0 for one that is high
    glm::dvec3 sunlight_hue_{1.0}; ///< of luminance 1
};

/// The position of the sun, and the colour that the horizon has under a sun of 35 degrees.
struct DaylightOptions {
    double sun_azimuth_rad = 0.0;           ///< clockwise from north
    double sun_elevation_rad = 0.6;         ///< negative values count as 0
    glm::vec3 horizon{0.62F, 0.72F, 0.84F}; ///< display values
    /// Display colour of dust that fills the air and colours the sky, as on Mars; nothing in clear air.
    std::optional<glm::vec3> dust = {};
};

/// Colours of the sky, the haze and the light for one position of the sun, display values, as a camera shows them whose
/// exposure follows the light on the ground: under a low sun shade is shown lighter than under a high one.
class Daylight {
public:
    explicit Daylight(const DaylightOptions& options);

    /// Unit vector, world axes.
    const glm::dvec3& to_sun() const { return to_sun_; }

    /// Horizontal unit vector towards the sun; 0 if the sun is overhead.
    const glm::dvec2& horizontal_to_sun() const { return horizontal_to_sun_; }

    /// Factors on the colour of a surface: ambient() + sunlight() * cosine between its normal and to_sun().
    const glm::vec3& ambient() const { return ambient_; }

    const glm::vec3& sunlight() const { return sunlight_; }

    /// The colour of horizon and haze away from the sun and towards it; horizon() interpolates between them.
    const glm::vec3& haze_away() const { return haze_away_; }

    const glm::vec3& haze_sunward() const { return haze_sunward_; }

    /// `cos_to_sun`: the cosine of the horizontal angle from the sun.
    glm::vec3 horizon(double cos_to_sun) const;

    /// The sky without the sun's disc in a direction (unit, world axes) at or above the horizon.
    glm::vec3 sky(const glm::dvec3& direction) const;

    const glm::vec3& disc() const { return disc_; }

    /// What the sun's glare adds to the colour of the sky at an angle from the sun's middle.
    glm::vec3 glare(double from_sun_rad) const;

    static constexpr double disc_rad = 0.00465;  ///< angular radius of the sun's disc
    static constexpr double glare_rad = 0.41888; ///< angular radius of the glare

private:
    /// `exposed`: what ExposedSky gives.
    glm::vec3 displayed(const glm::dvec3& exposed) const;

    ExposedSky sky_;
    glm::dvec3 to_sun_;
    glm::dvec2 horizontal_to_sun_{0.0};
    std::optional<glm::dvec3> air_tint_; ///< of luminance 1, by dust
    glm::vec3 ambient_{0.0F};
    glm::vec3 sunlight_{0.0F};
    glm::vec3 haze_away_{0.0F};
    glm::vec3 haze_sunward_{0.0F};
    glm::vec3 disc_{0.0F};
};

/// Reflection of sky and sun in a slightly rough sea.
class WaterReflection {
public:
    explicit WaterReflection(const Daylight& day);

    /// The colour of a position, display values. `own`: the colour of the water without reflection; `from_eye`: the
    /// direction from the eye to the position, of any length, downwards.
    glm::vec3 shaded_colour(const glm::vec3& own, const glm::vec3& from_eye) const;

private:
    static constexpr std::size_t heights = 9; ///< of the sky, evenly in the sine of elevation

    glm::vec3 sky(const glm::vec3& direction) const;

    /// How much of the sun's colour the facets of the water add on a unit vector away from the eye.
    float glitter_towards(const glm::vec3& way) const;

    glm::vec3 to_sun_;
    glm::vec2 horizontal_to_sun_;
    glm::vec3 sun_;
    std::array<glm::vec3, heights> sky_away_{};
    std::array<glm::vec3, heights> sky_sunward_{};
};

} // namespace octant::visuals::nature
