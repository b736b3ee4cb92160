#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace octant {

/// Bytes of the UTF-8 character that `text` (not empty) starts with, 0 when it starts with none.
std::size_t utf8_length(std::string_view text);

/// A text from anywhere (file names among it) as one line that a terminal only shows: line ends and tabs become blanks;
/// other control characters, and bytes that are no UTF-8, become '?'.
std::string one_line(std::string_view text);

} // namespace octant
