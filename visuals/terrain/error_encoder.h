#pragma once

#include "visuals/terrain/error_codes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::terrain {

/// ErrorCodes::code_of for errors given in units of the stored numbers, by table: the leading bits of a float select a
/// code, and one comparison corrects it.
class ErrorEncoder {
public:
    ErrorEncoder(const ErrorCodes& codes, double unit_m) : unit_m_(static_cast<float>(unit_m)), metres_(codes) {
        for (std::size_t code = 0; code < steps_.size(); ++code) {
            steps_[code] = codes.metres(static_cast<std::uint8_t>(code)) / unit_m_;
        }
        first_ = bin_of(metres_.metres(1));
        const std::uint32_t last = bin_of(metres_.metres(255)) + 1;
        for (std::uint32_t bin = first_; bin <= last; ++bin) {
            const auto lowest_m = std::bit_cast<float>(bin << dropped_bits);
            codes_.push_back(metres_.code_of(lowest_m));
        }
    }

    std::uint8_t code_of(float steps) const {
        const float error_m = steps * unit_m_;
        const std::uint32_t bin = bin_of(error_m);
        if (bin < first_) { return error_m > 0.0F ? 1 : 0; }
        const std::uint8_t code = codes_[std::min<std::size_t>(bin - first_, codes_.size() - 1)];
        return static_cast<std::uint8_t>(code + (code < 255 && error_m > metres_.metres(code) ? 1 : 0));
    }

    /// The error of a code in units of the stored numbers.
    float steps_of(std::uint8_t code) const { return steps_[code]; }

private:
    /// A bin spans 1/64 to 1/32 of an octave, which is narrower than the step between two codes.
    static constexpr unsigned dropped_bits = 17;

    static std::uint32_t bin_of(float error_m) { return std::bit_cast<std::uint32_t>(error_m) >> dropped_bits; }

    float unit_m_;
    ErrorCodes metres_;
    std::array<float, 256> steps_{};
    std::uint32_t first_ = 0;
    std::vector<std::uint8_t> codes_;
};

} // namespace octant::visuals::terrain
