// Tables of error codes: geometric series, so that one byte covers centimetres to kilometres. An error is rounded up to
// its code, by half a step in the mean, and that costs triangles: steps are narrow where meshes have most of their
// samples.
#include "visuals/terrain/error_codes.h"

#include <algorithm>
#include <cstddef>

namespace octant::visuals::terrain {

ErrorCodes ErrorCodes::legacy() {
    constexpr double smallest_m = 0.01;
    constexpr double ratio = 1.0567; // the 254 steps reach 12,100 m
    ErrorCodes codes;
    double error_m = smallest_m;
    for (std::size_t code = 1; code < codes.metres_.size(); ++code) {
        codes.metres_[code] = static_cast<float>(error_m);
        error_m *= ratio;
    }
    return codes;
}

ErrorCodes ErrorCodes::for_height_unit(double height_unit_m) {
    // Numbers, not roots: a file means the same wherever it is read.
    constexpr double wide = 1.148698355;   // 20 steps to 16 times
    constexpr double narrow = 1.036271381; // 214 steps to 2048 times
    constexpr std::size_t first_narrow = 21;
    constexpr std::size_t end_narrow = 235;
    ErrorCodes codes;
    double units = 0.25;
    for (std::size_t code = 1; code < codes.metres_.size(); ++code) {
        codes.metres_[code] = static_cast<float>(units * height_unit_m);
        units *= code >= first_narrow && code < end_narrow ? narrow : wide;
    }
    return codes;
}

std::uint8_t ErrorCodes::code_of(float error_m) const {
    const auto at = std::lower_bound(metres_.begin(), metres_.end(), error_m);
    return static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(at - metres_.begin(), 255));
}

} // namespace octant::visuals::terrain
