#pragma once

#include "sim/base/format_once.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace octant::visuals::overlay {

/// A few letters on the stack, at most 16; what is longer is cut.
class ShortText {
public:
    template <typename... Values>
    explicit ShortText(fmt::format_string<Values...> format, Values&&... values) {
        const auto written =
            fmt::format_to_n(letters_.data(), letters_.size(), format, std::forward<Values>(values)...);
        size_ = std::min(written.size, letters_.size());
    }

    std::string_view text() const { return {letters_.data(), size_}; }

private:
    std::array<char, 16> letters_{};
    std::size_t size_ = 0;
};

} // namespace octant::visuals::overlay
