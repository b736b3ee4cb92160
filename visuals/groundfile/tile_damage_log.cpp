#include "visuals/groundfile/tile_damage_log.h"

#include <fmt/format.h>
#include <map>
#include <mutex>
#include <set>
#include <tuple>

namespace octant::visuals::groundfile {

namespace {

using TileKey = std::tuple<int, std::size_t, std::size_t>; ///< level, row, column

struct DamageLog {
    std::mutex mutex;
    std::map<std::filesystem::path, std::set<TileKey>> tiles;
};

DamageLog& damage_log() {
    static DamageLog all;
    return all;
}

} // namespace

void log_tile_damage(const std::filesystem::path& file, const DamagedTile& tile) {
    DamageLog& all = damage_log();
    const std::scoped_lock lock(all.mutex);
    all.tiles[file].insert({tile.level, tile.row, tile.column});
}

std::vector<std::string> tile_damage_messages() {
    DamageLog& all = damage_log();
    const std::scoped_lock lock(all.mutex);
    std::vector<std::string> lines;
    for (const auto& [file, tiles] : all.tiles) {
        const auto& [level, row, column] = *tiles.begin();
        lines.push_back(
            fmt::format("{}: expected sound tiles, got damage in {} tile{} (the coarsest in level {}, column "
                        "{}, "
                        "row {}), "
                        "where a coarser ground was shown: import it again",
                file.string(), tiles.size(), tiles.size() == 1 ? "" : "s", level, column, row));
    }
    return lines;
}

} // namespace octant::visuals::groundfile
