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

/// How far an import has come, so that it can go on after a stop.
struct ImportProgress {
    enum class Stage : std::uint32_t { Scanning, Reading, Filling, Building, Complete };

    Stage stage = Stage::Scanning;
    std::uint64_t inputs = 0;     ///< A hash of the input files and of the options of the import.
    std::uint64_t rows_done = 0;  ///< Rows of the field, counted from the north.
    std::uint64_t tiles_done = 0; ///< Tiles in the order in which they are built.
    std::int64_t voids = 0;
    double lowest_m = 0.0; ///< The lowest height of the rows read so far.
    double highest_m = 0.0;
};

/// The first page of a ground's file: an archive (sim/base/binary_file.h) filled up with zeros. After it come
/// GroundLayout memory and then the checksums (sim/base/hash.h), 8 bytes each: one of the memory before the tiles and
/// one of every tile in memory order. Little endian.
struct GroundHeader {
    static constexpr std::size_t bytes = GroundLayout::page_bytes;

    GroundShape shape;
    GroundMetadata metadata;
    ImportProgress progress;
    std::uint64_t checksums = 0; ///< The checksum of the checksums.
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

/// Whether a file may have this spacing (1e-3 to 1e6 m), base (within 1e5 m) and unit (a power of two from 2^-12 to 1
/// m).
bool is_storable(const GroundShape& shape);

/// The page to write. A name of more than 256 bytes is cut between two characters; a coordinate system whose text has
/// more than 3072 bytes is left out.
std::array<std::byte, GroundHeader::bytes> header_page(const GroundHeader& header);

/// The header at the beginning of a file's bytes. The name is UTF-8 without control characters, whatever the file
/// holds. Throws Error if there is no header, or if it is damaged, of another version or of another layout.
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
