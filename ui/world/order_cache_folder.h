#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace octant::ui::world {

/// The folder in which painting orders and prepared meshes are cached by this value of --order-cache, made if missing;
/// nothing for "none". The user's own cache is cut down to 256 MiB; if it cannot be made or written, nothing. Throws
/// Error for a named folder that cannot be made.
std::optional<std::filesystem::path> order_cache_folder(const std::string& value);

/// Removes the oldest files of such a folder until the rest takes at most `max_bytes`. Ignores files that are not of
/// the cache, that another run is writing or that cannot be removed.
void remove_oldest(const std::filesystem::path& folder, std::uintmax_t max_bytes);

} // namespace octant::ui::world
