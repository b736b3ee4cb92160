#pragma once

#include "ui/studies/shading_pictures.h"

#include <cstdint>
#include <span>

namespace octant::ui::studies {

/// What a screen shows as white: red + green + blue.
inline constexpr double white_light = 3.0;

/// Mean square of the difference over the covered pixels; 0 where nothing is covered.
double mean_square_error(
    const LightPicture& picture, const LightPicture& reference, std::span<const std::uint8_t> covered);

/// Peak signal to noise in decibels of white_light, infinite where the error is 0.
double psnr_db(double mean_square);

/// Structural similarity (Wang et al. 2004) of square windows of 7 x 7 pixels, covered ones only, averaged over all
/// covered pixels as middles: K1 = 0.01, K2 = 0.03, range white_light. 1 = equal.
double structural_similarity(
    const LightPicture& picture, const LightPicture& reference, std::span<const std::uint8_t> covered);

} // namespace octant::ui::studies
