// Opens imported grounds. A file of 16385 x 16385 samples is 940 MB; mapping it makes flights over
// it start at once, and only the tiles that a mesh looks at are read.
#include "visuals/groundfile/ground_file.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/parallel_for.h"
#include "visuals/groundfile/ground_header.h"
#include "visuals/groundfile/mapped_file.h"
#include "visuals/groundfile/tile_checksums.h"

#include <atomic>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <utility>

namespace octant::visuals::groundfile {

namespace {

using std::filesystem::path;

std::span<const std::byte> memory_of(const MappedFile& file, const GroundLayout& layout) {
    return file.bytes().subspan(GroundHeader::bytes, layout.total_bytes());
}

std::uint64_t checksum_at(const MappedFile& file, const GroundFileLayout& plan, std::size_t index) {
    std::uint64_t checksum = 0;
    std::memcpy(&checksum, file.bytes().data() + plan.checksums + 8 * index, 8);
    return checksum;
}

/// Throws Error unless the file is finished, has its full length and is sound before the tiles.
void check_before_tiles(const path& path, const MappedFile& file, const GroundHeader& header) {
    const GroundLayout layout(shape_of(header));
    const GroundFileLayout plan(layout);
    if (header.progress.stage != ImportProgress::Stage::Complete) {
        throw_error_in(path, "expected a finished ground, got one whose import was stopped");
    }
    if (file.bytes().size() != plan.file_bytes) {
        throw_error_in(
            path,
            fmt::format(
                "expected {} bytes, got {}: copy or import it again",
                plan.file_bytes,
                file.bytes().size()));
    }
    if (checksum_of(file.bytes().subspan(plan.checksums)) != header.checksums ||
        checksum_of(memory_of(file, layout).first(layout.first_tile())) !=
            checksum_at(file, plan, 0)) {
        throw_error_in(path, "expected sound data before the tiles, got damage: import it again");
    }
}

} // namespace

bool is_ground_file(const path& path) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(path, code)) {
        return false;
    }
    std::array<char, GroundHeader::current_magic.size()> magic = {};
    std::ifstream(path, std::ios::binary).read(magic.data(), magic.size());
    return magic == GroundHeader::current_magic;
}

GroundTiles open_ground(const path& path) {
    const auto file = std::make_shared<MappedFile>(path, MappedFile::Access::CopyOnWrite);
    const GroundHeader header = read_header(path, std::as_const(*file).bytes());
    check_before_tiles(path, *file, header);
    const GroundShape shape = shape_of(header);
    const GroundLayout layout(shape);
    const auto tested = std::make_shared<const ChecksumValidator>(path, file, header);
    return {shape, metadata_of(header), memory_of(*file, layout), file, tested};
}

std::uint64_t hash_of_ground(const path& path) {
    const MappedFile file(path, MappedFile::Access::Read);
    const GroundHeader header = read_header(path, file.bytes());
    check_before_tiles(path, file, header);
    const GroundLayout layout(shape_of(header));
    Hash hash;
    hash.add(file.bytes().first(GroundHeader::bytes + layout.first_tile()));
    hash.add(file.bytes().subspan(GroundFileLayout(layout).checksums));
    return hash.value();
}

void verify_ground(const path& path, int threads) {
    const MappedFile file(path, MappedFile::Access::Read);
    const GroundHeader header = read_header(path, file.bytes());
    check_before_tiles(path, file, header);
    const GroundLayout layout(shape_of(header));
    const GroundFileLayout plan(layout);
    std::size_t before = 1;
    for (int level = 0; level < layout.levels(); ++level) {
        const GroundLayout::Level& at = layout.level(level);
        const std::size_t count =
            static_cast<std::size_t>(at.tiles_across) * static_cast<std::size_t>(at.tiles_up);
        std::atomic<std::size_t> first_bad = count;
        parallel_for(count, threads, [&](std::size_t tile, std::size_t /*worker*/) {
            const auto bytes = memory_of(file, layout)
                                   .subspan(at.first_tile + tile * at.tile_bytes, at.tile_bytes);
            if (checksum_of(bytes) != checksum_at(file, plan, before + tile)) {
                std::size_t known = first_bad;
                while (tile < known && !first_bad.compare_exchange_weak(known, tile)) {
                }
            }
        });
        if (first_bad < count) {
            const auto across = static_cast<std::size_t>(at.tiles_across);
            throw_error_in(
                path,
                fmt::format(
                    "expected sound tiles, got damage in level {}, tile column {}, row {}: import "
                    "it again",
                    level,
                    first_bad % across,
                    first_bad / across));
        }
        before += count;
    }
}

} // namespace octant::visuals::groundfile
