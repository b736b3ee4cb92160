#pragma once

#include "visuals/terrain/ground_layout.h"
#include "visuals/terrain/ground_tiles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace octant::visuals::terrain {

/// How far the making of a ground's file has come.
struct GroundProgress {
    enum class Stage : std::uint32_t { Scanning, Reading, Filling, Building, Complete };

    Stage stage = Stage::Scanning;
    std::uint32_t reserved = 0;
    std::uint64_t inputs = 0;     ///< hash of what it is made from
    std::uint64_t rows_done = 0;  ///< of the field, from the north
    std::uint64_t tiles_done = 0; ///< in the order of building
    std::int64_t voids = 0;
    double lowest_m = 0.0; ///< of the rows read
    double highest_m = 0.0;
};

/// models::MapSystem in a file. A text that is too long is left out, and the system with it.
struct GroundSystem {
    double centre_x = 0.0;
    double centre_y = 0.0;
    double unit_m = 0.0;
    std::uint32_t wkt_length = 0; ///< 0: the ground has no system
    std::uint32_t reserved = 0;
    std::array<char, 3072> wkt = {};
};

/// The first page of a ground's file. Then follow GroundLayout memory and, 8 bytes each, checksums
/// (sim/base/hash.h) of what lies before the tiles and of every tile as they lie. Little endian.
struct GroundHeader {
    static constexpr std::size_t bytes = GroundLayout::page_bytes;
    static constexpr std::array<char, 16> right_magic = {
        'o', 'c', 't', 'a', 'n', 't', ' ', 'g', 'r', 'o', 'u', 'n', 'd', '\r', '\n', '\x1a'};
    static constexpr std::uint32_t right_version = 2;
    static constexpr std::uint32_t first_version = 1; ///< without a system, else the same

    std::array<char, 16> magic = right_magic;
    std::uint32_t version = right_version;
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
    std::uint64_t layout = 0;    ///< hash of the places of all numbers
    std::uint64_t checksums = 0; ///< checksum of the checksums
    GroundProgress progress;
    std::uint64_t checksum = 0; ///< of all above
    GroundSystem system;
    std::uint64_t system_checksum = 0; ///< of the system
};

/// Sizes and places that a file of this shape has.
struct GroundFilePlan {
    explicit GroundFilePlan(const GroundLayout& layout);

    std::size_t tiles = 0;
    std::size_t checksums = 0;  ///< offset
    std::size_t file_bytes = 0; ///< of a complete file
    std::size_t numbers = 0;    ///< offset of the field's rows in a file being made
};

std::uint64_t hash_of(std::span<const std::byte> bytes);
std::uint64_t hash_of(const GroundLayout& layout);

/// A name that is too long is cut between two characters.
GroundHeader header_of(const GroundShape& shape, const GroundFacts& facts);
GroundShape shape_of(const GroundHeader& header);

/// The name as UTF-8 without control characters, whatever the bytes in the file.
GroundFacts facts_of(const GroundHeader& header);

/// Whether spacing (1e-3 to 1e6 m), base (1e5 m up or down) and unit (a power of two from 2^-12 to
/// 1 m) are such as a file may have.
bool may_be_stored(const GroundShape& shape);

/// The page to write, with its checksum.
std::array<std::byte, GroundHeader::bytes> page_of(GroundHeader header);

/// The header at the beginning of a file's bytes, of this version or an earlier one. Throws Error
/// when it is neither, damaged or does not fit the layout of today.
GroundHeader read_header(const std::filesystem::path& path, std::span<const std::byte> file);

} // namespace octant::visuals::terrain
