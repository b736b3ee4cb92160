#pragma once

#include <array>
#include <cstdint>

namespace octant::visuals::terrain {

/// What the one-byte codes of a ground's errors mean, in metres: 0 for code 0 and ascending. An error's code is the
/// smallest whose metres are at or above it.
class ErrorCodes {
public:
    /// The codes of all grounds of file versions 1 to 4: 10 mm to 12 km in steps of 5.7 %.
    static ErrorCodes legacy();

    /// The codes of a ground that stores heights in units of so many metres, a power of two. It spans at most 65,000
    /// units, and its codes a quarter of a unit to 2^17 units. The steps are of 3.6 % from 4 to 8192 units and of 15 %
    /// beside them: smaller errors matter only to an eye close to the ground, larger ones are few.
    static ErrorCodes for_height_unit(double height_unit_m);

    float metres(std::uint8_t code) const { return metres_[code]; }

    /// 255 for errors beyond all.
    std::uint8_t code_of(float error_m) const;

private:
    ErrorCodes() = default;

    std::array<float, 256> metres_{};
};

} // namespace octant::visuals::terrain
