#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace octant::ui::world {

/// What the user's own cache may hold.
inline constexpr std::uintmax_t max_bytes_of_user_cache = std::uintmax_t{256} << 20;

/// The folder that a value of --order-cache means, made where it is missing; nothing for none. The
/// user's own cache is done without where it cannot be made or written; a folder that is named and
/// cannot be is an Error.
std::optional<std::filesystem::path> order_cache_folder(const std::string& value);

/// Removes the files of a folder that were written first, until the rest is no larger than that.
/// What cannot be removed stays.
void remove_oldest(const std::filesystem::path& folder, std::uintmax_t max_bytes);

} // namespace octant::ui::world
