#include "visuals/groundfile/tile_checksums.h"

#include "sim/base/hash.h"
#include "visuals/groundfile/tile_damage_log.h"
#include "visuals/groundfile/tile_repair.h"

#include <cstring>
#include <utility>

namespace octant::visuals::groundfile {

namespace {

std::span<const std::byte> tile_bytes(const GroundTiles& ground, int level, std::size_t tile) {
    const GroundLayout::Level& at = ground.layout().level(level);
    return ground.memory().subspan(at.first_tile + tile * at.tile_bytes, at.tile_bytes);
}

} // namespace

ChecksumValidator::ChecksumValidator(
    std::filesystem::path path, std::shared_ptr<MappedFile> file, const GroundHeader& header)
    : TileValidator(GroundLayout(shape_of(header)), false)
    , path_(std::move(path))
    , file_(std::move(file))
    , ground_(
          shape_of(header),
          metadata_of(header),
          std::as_const(*file_).bytes().subspan(
              GroundHeader::bytes, GroundLayout(shape_of(header)).total_bytes()),
          nullptr,
          std::shared_ptr<const TileValidator>(std::shared_ptr<const void>(), this))
    , checksums_(GroundFileLayout(ground_.layout()).checksums)
    , bad_(GroundFileLayout(ground_.layout()).tiles) {}

bool ChecksumValidator::is_intact(int level, std::size_t tile) const {
    const std::scoped_lock lock(mutex_);
    const std::size_t index = index_of(level, tile);
    if (bad_[index] || is_valid(index)) {
        return !bad_[index];
    }
    std::uint64_t checksum = 0;
    const std::size_t place = checksums_ + 8 * (index + 1); // the first is of what lies before
    std::memcpy(&checksum, std::as_const(*file_).bytes().data() + place, sizeof checksum);
    return checksum_of(tile_bytes(ground_, level, tile)) == checksum;
}

void ChecksumValidator::validate(int level, std::size_t tile) const {
    const std::scoped_lock lock(mutex_);
    const std::size_t index = index_of(level, tile);
    if (is_valid(index)) {
        return;
    }
    if (!is_intact(level, tile)) {
        bad_[index] = true;
        const GroundLayout::Level& at = ground_.layout().level(level);
        const auto across = static_cast<std::size_t>(at.tiles_across);
        log_tile_damage(path_, {level, tile % across, tile / across});
        const std::span<const std::byte> bytes = tile_bytes(ground_, level, tile);
        const auto offset =
            static_cast<std::size_t>(bytes.data() - std::as_const(*file_).bytes().data());
        repair_tile(
            [this](int l, std::size_t t) { return is_intact(l, t); },
            ground_,
            {level, tile},
            file_->writable_copy(offset, bytes.size()));
    }
    set_valid(index);
}

} // namespace octant::visuals::groundfile
