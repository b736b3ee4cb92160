#pragma once

#include "visuals/terrain/bisection_tiles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::groundfile {

using terrain::GroundLayout;
using terrain::GroundMetadata;
using terrain::GroundShape;
using terrain::GroundTiles;

/// How far the making of a ground's file has come, so that it can go on after a stop.
struct ImportProgress {
    enum class Stage : std::uint32_t { Scanning, Reading, Filling, Building, Complete };

    Stage stage = Stage::Scanning;
    std::uint32_t reserved = 0;
    std::uint64_t inputs = 0;     ///< A hash of what it is made from.
    std::uint64_t rows_done = 0;  ///< Rows of the field, counted from the north.
    std::uint64_t tiles_done = 0; ///< Tiles in the order in which they are built.
    std::int64_t voids = 0;
    double lowest_m = 0.0; ///< The lowest height of the rows read so far.
    double highest_m = 0.0;
};

/// A models::heights::CoordinateSystem in a file. If its text is too long, the system is left out.
struct StoredMapSystem {
    double centre_x = 0.0;
    double centre_y = 0.0;
    double unit_m = 0.0;
    std::uint32_t wkt_length = 0; ///< 0 = the ground has no system.
    std::uint32_t reserved = 0;
    std::array<char, 3072> wkt = {};
};

/// A models::heights::Deviation in a file; without places it was not measured.
struct StoredDeviation {
    double rms_m = 0.0;
    double worst_m = 0.0;
    std::int64_t places = 0;
};

/// The first page of a ground's file. After it come GroundLayout memory and then the checksums (sim/base/hash.h), 8
/// bytes each: one of what lies before the tiles and one of every tile in memory order. Little endian.
struct GroundHeader {
    static constexpr std::size_t bytes = GroundLayout::page_bytes;
    static constexpr std::array<char, 16> current_magic = {
        'o', 'c', 't', 'a', 'n', 't', ' ', 'g', 'r', 'o', 'u', 'n', 'd', '\r', '\n', '\x1a'};
    /// Version 5: errors and heights beyond the field's border are those of a field that repeats its last column and
    /// row; read_header takes only fields without such samples. 4: also with the codes of all grounds
    /// (GroundShape::has_unit_codes). 3: also without the errors without margin (GroundShape::has_both_margins). 2:
    /// also without a deviation. 1: also without a system.
    static constexpr std::uint32_t current_version = 6;

    std::array<char, 16> magic = current_magic;
    std::uint32_t version = current_version;
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    std::uint32_t has_place = 0;
    double spacing_m = 0.0;
    double height_base_m = 0.0;
    double height_unit_m = 0.0;
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    std::int64_t filled_voids = 0;
    float lowest_m = 0.0F;
    float highest_m = 0.0F;
    float mean_m = 0.0F;
    std::uint32_t name_length = 0;
    std::array<char, 256> name = {};
    std::uint64_t layout = 0;    ///< hash_of(GroundShape).
    std::uint64_t checksums = 0; ///< The checksum of the checksums.
    ImportProgress progress;
    std::uint64_t checksum = 0; ///< The checksum of all members above.
    StoredMapSystem system;
    std::uint64_t system_checksum = 0; ///< The checksum of the system.
    StoredDeviation deviation;
    std::uint64_t deviation_checksum = 0; ///< The checksum of the deviation.
};

/// The sizes and offsets in a file of a given layout.
struct GroundFileLayout {
    explicit GroundFileLayout(const GroundLayout& layout);

    std::size_t tiles = 0;
    std::size_t checksums = 0;  ///< The offset of the checksums.
    std::size_t file_bytes = 0; ///< The size of a complete file.
    std::size_t numbers = 0;    ///< The offset of the field's rows while the file is being made.
};

/// The hash of the places of all numbers and of what error codes mean.
std::uint64_t hash_of(const GroundShape& shape);

/// The header of a ground. A name that is too long is cut between two characters.
GroundHeader header_of(const GroundShape& shape, const GroundMetadata& metadata);
GroundShape shape_of(const GroundHeader& header);

/// The facts in a header. The name is UTF-8 without control characters, whatever the file holds.
GroundMetadata metadata_of(const GroundHeader& header);

/// Whether a file may have this spacing (1e-3 to 1e6 m), base (within 1e5 m) and unit (a power of two from 2^-12 to 1
/// m).
bool is_storable(const GroundShape& shape);

/// The page to write, with its checksums.
std::array<std::byte, GroundHeader::bytes> header_page(GroundHeader header);

/// The header at the beginning of a file's bytes, of this version or an earlier one. Throws Error when there is none,
/// when it is damaged, or when it does not fit today's layout. Throws Error also for a version below 6 where the field
/// is not a square of 2^n + 1 samples.
GroundHeader read_header(const std::filesystem::path& path, std::span<const std::byte> file);

/// Whether a file begins as ground files do, whether it is sound or not. Never throws.
bool is_ground_file(const std::filesystem::path& path);

/// Maps a ground into memory; its pages come from the disk when they are first read. Checks everything but the tiles.
/// Each tile is checked when it is first read; a damaged tile is repaired in memory and counted
/// (tile_damage_messages).
/// Throws Error (no such file, another kind of file, unfinished, cut off or damaged before the tiles).
GroundTiles open_ground(const std::filesystem::path& path);

/// A hash of the header, of the bytes before the tiles and of the checksums of all tiles. It distinguishes grounds
/// without reading the tiles. Throws Error as open_ground does.
std::uint64_t hash_of_ground(const std::filesystem::path& path);

/// One line for each ground file in which this program met damage so far: how many tiles, and the first of them by
/// level and place. Empty when there was none.
std::vector<std::string> tile_damage_messages();

/// Checks the tiles, too, which reads the whole file. Throws Error that names the first bad tile.
void verify_ground(const std::filesystem::path& path, int threads = 2);

} // namespace octant::visuals::groundfile
