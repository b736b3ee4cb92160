#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/ordered_model.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace octant::visuals::ordercache {

/// Raised whenever draworder::ordered() gives any model another result, or a file another layout:
/// what was kept before is then computed anew.
inline constexpr std::uint32_t order_version = 9;

/// An ordered model, and how it was come by.
struct CachedOrder {
    draworder::OrderedModel ordered;
    bool was_cached = false;          ///< Read, not computed.
    std::filesystem::path file;     ///< Where it is kept, named by what decides the order.
    std::vector<std::string> notes; ///< A file that could not be used, or not be written.
};

/// Makes the folder, and its parents, where it is missing. Throws Error where that is not possible
/// or nothing can be written into it.
void make_cache_folder(const std::filesystem::path& folder);

/// draworder::ordered(), read from the folder where the same model was ordered with the same
/// options before, else computed and kept there. The result is the same, bit for bit. A file that
/// is damaged, of another version or of another model with the same hash is computed anew and
/// replaced, with a note. Processes may share a folder: files appear whole.
CachedOrder cached_order(
    const std::filesystem::path& folder,
    models::polygons::PolygonModel model,
    const draworder::OrderOptions& options);

} // namespace octant::visuals::ordercache
