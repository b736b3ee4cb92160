#pragma once

#include <cstddef>
#include <string_view>

namespace octant {

/// Bytes of the UTF-8 character that `text` (not empty) starts with, 0 when it starts with none.
std::size_t utf8_length(std::string_view text);

} // namespace octant
