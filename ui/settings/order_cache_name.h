#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace octant::ui::settings {

/// Values of --order-cache that are no folders: the user's own cache, and none.
inline constexpr std::string_view user_order_cache = "user";
inline constexpr std::string_view no_order_cache = "none";
inline constexpr std::array built_in_order_caches{user_order_cache, no_order_cache};

/// Whether a value of --order-cache is a folder.
constexpr bool is_order_cache_folder(std::string_view value) {
    return std::ranges::find(built_in_order_caches, value) == built_in_order_caches.end();
}

} // namespace octant::ui::settings
