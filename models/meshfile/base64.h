#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace octant::models::meshfile {

std::string base64_text(std::string_view bytes);

/// Nothing for what is no base64; the marks at the end may be missing.
std::optional<std::string> base64_bytes(std::string_view text);

} // namespace octant::models::meshfile
