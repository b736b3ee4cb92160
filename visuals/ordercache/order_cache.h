#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/ordered_model.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octant::visuals::ordercache {

/// All that decides which order a model gets: its corners, polygons, parts and pivots, and the options. The names of
/// the model and its materials, and colours, are not in it.
std::string encode_key(const models::polygons::PolygonModel& model, const draworder::OrderOptions& options);

/// An ordered model without what it has from the model as given (decode_order).
std::string encode_order(const draworder::OrderedModel& ordered);

/// The inverse of encode_order, bit for bit. `given` is the model that was ordered; names, materials, parts and pivots
/// are its own. The bytes may be anything: every number that leads to something is checked. Throws Error "at byte N:
/// expected ..., got ...".
draworder::OrderedModel decode_order(std::string_view bytes, const models::polygons::PolygonModel& given);

/// Raised whenever draworder::ordered() gives any model another result, or a file another layout: what was kept before
/// is then computed anew.
inline constexpr std::uint32_t order_version = 12;

/// An ordered model, and how it was come by.
struct CachedOrder {
    draworder::OrderedModel ordered;
    bool was_cached = false;        ///< Read, not computed.
    std::filesystem::path file;     ///< Where it is kept, named by what decides the order.
    std::vector<std::string> notes; ///< A file that could not be used, or not be written.
};

/// Makes the folder, and its parents, where it is missing. Throws Error where that is not possible or nothing can be
/// written into it.
void make_cache_folder(const std::filesystem::path& folder);

/// draworder::ordered(), read from the folder where the same model was ordered with the same options before, else
/// computed and kept there. The result is the same, bit for bit. A file that is damaged, of another version or of
/// another model with the same hash is computed anew and replaced, with a note. Processes may share a folder: files
/// appear whole.
CachedOrder cached_order(
    const std::filesystem::path& folder, models::polygons::PolygonModel model, const draworder::OrderOptions& options);

} // namespace octant::visuals::ordercache
