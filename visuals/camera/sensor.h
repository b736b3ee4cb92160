#pragma once

#include <cstdint>
#include <span>

namespace octant::visuals::camera {

// Colours are display values, 65535 = full, three for each pixel. Light is linear, 1 = full; from colours by the
// transfer function of sRGB.

/// Light of a colour.
float light_of(std::uint16_t colour);

/// The colour of light, which is clipped to 0 .. 1.
std::uint16_t colour_of(float light);

/// Adds the light of colours to sums.
void add_light(std::span<const std::uint16_t> colours, std::span<float> sums);

/// What becomes of light in a camera.
struct Sensor {
    double exposure = 1.0; ///< factor of light
    /// The standard deviation of the colour of a pixel of half the full display value, as a share of that.
    ///
    /// The noise of light L has the variance s^2 (15/16 L / L_grey + 1/16): the first part is that of photons, the
    /// second that of reading; both are normally distributed, without ties between pixels, colours and pictures. What
    /// it makes of light is clipped then.
    double noise = 0.0;

    /// Which noise a picture has: the same for the same numbers, and that of no picture with others.
    struct NoiseKey {
        std::uint64_t seed = 0;
        std::uint64_t picture = 0;
    };

    /// The colours of a picture from sums of the light of `count` pictures. The same bits on any processor.
    void develop(std::span<const float> sums, int count, const NoiseKey& key, std::span<std::uint16_t> colours) const;
};

/// Colours as bytes, 255 = full, rounded.
void to_bytes(std::span<const std::uint16_t> colours, std::span<std::uint8_t> bytes);

} // namespace octant::visuals::camera
