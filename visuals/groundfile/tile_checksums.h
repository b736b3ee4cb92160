#pragma once

#include "visuals/groundfile/ground_header.h"
#include "visuals/groundfile/mapped_file.h"
#include "visuals/terrain/tile_validator.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

namespace octant::visuals::groundfile {

/// The tiles of a mapped file, each held against its checksum when it is first read. A bad one is
/// mended in memory (tile_mender.h), never in the file, and goes into damage_tally.h.
class ChecksumValidator final : public terrain::TileValidator {
public:
    /// A finished file, sound before its tiles, mapped with Access::CopyOnWrite, and its header.
    ChecksumValidator(
        std::filesystem::path path, std::shared_ptr<MappedFile> file, const GroundHeader& header);

private:
    /// Whether a tile's bytes in the file are those of its checksum; of a mended one: no.
    bool is_intact(int level, std::size_t tile) const;
    void validate(int level, std::size_t tile) const override;

    std::filesystem::path path_;
    std::shared_ptr<MappedFile> file_;
    GroundTiles ground_; ///< Over the same memory, guarded by this object.
    std::size_t checksums_;
    /// Held while a tile is tested or mended, which may lead to others.
    mutable std::recursive_mutex mutex_;
    mutable std::vector<bool> bad_;
};

} // namespace octant::visuals::groundfile
