#include "visuals/groundfile/tested_tiles.h"

#include "sim/base/hash.h"
#include "visuals/groundfile/damage_tally.h"
#include "visuals/groundfile/tile_mender.h"

#include <cstring>
#include <utility>

namespace octant::visuals::groundfile {

namespace {

std::span<const std::byte> tile_bytes(const GroundTiles& ground, int level, std::size_t tile) {
    const GroundLayout::Level& at = ground.layout().level(level);
    return ground.memory().subspan(at.first_tile + tile * at.tile_bytes, at.tile_bytes);
}

} // namespace

TestedTiles::TestedTiles(
    std::filesystem::path path, std::shared_ptr<MappedFile> file, const GroundHeader& header)
    : TileGuard(GroundLayout(shape_of(header)), false)
    , path_(std::move(path))
    , file_(std::move(file))
    , ground_(
          shape_of(header),
          facts_of(header),
          std::as_const(*file_).bytes().subspan(
              GroundHeader::bytes, GroundLayout(shape_of(header)).total_bytes()),
          nullptr,
          std::shared_ptr<const TileGuard>(std::shared_ptr<const void>(), this))
    , checksums_(GroundFilePlan(ground_.layout()).checksums)
    , bad_(GroundFilePlan(ground_.layout()).tiles) {}

bool TestedTiles::is_sound(int level, std::size_t tile) const {
    const std::scoped_lock lock(mutex_);
    const std::size_t index = index_of(level, tile);
    if (bad_[index] || is_ready(index)) {
        return !bad_[index];
    }
    std::uint64_t checksum = 0;
    const std::size_t place = checksums_ + 8 * (index + 1); // the first is of what lies before
    std::memcpy(&checksum, std::as_const(*file_).bytes().data() + place, sizeof checksum);
    return checksum_of(tile_bytes(ground_, level, tile)) == checksum;
}

void TestedTiles::make_ready(int level, std::size_t tile) const {
    const std::scoped_lock lock(mutex_);
    const std::size_t index = index_of(level, tile);
    if (is_ready(index)) {
        return;
    }
    if (!is_sound(level, tile)) {
        bad_[index] = true;
        const GroundLayout::Level& at = ground_.layout().level(level);
        const auto across = static_cast<std::size_t>(at.tiles_across);
        note_damage(path_, {level, tile % across, tile / across});
        const std::span<const std::byte> bytes = tile_bytes(ground_, level, tile);
        const auto offset =
            static_cast<std::size_t>(bytes.data() - std::as_const(*file_).bytes().data());
        mend_tile(
            [this](int l, std::size_t t) { return is_sound(l, t); },
            ground_,
            {level, tile},
            file_->mendable(offset, bytes.size()));
    }
    set_ready(index);
}

} // namespace octant::visuals::groundfile
