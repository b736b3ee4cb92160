// Writes and checks the first page of a ground's file. Files come from outside: every number is checked before it is
// used, and a hash of the layout refuses files of another release.
#include "visuals/groundfile/ground_header.h"

#include "models/heights/local_frame.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/utf8.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <type_traits>

namespace octant::visuals::groundfile {

static_assert(std::is_trivially_copyable_v<GroundHeader> && sizeof(GroundHeader) <= 4096);
static_assert(std::endian::native == std::endian::little);
static_assert(std::has_unique_object_representations_v<ImportProgress::Stage>);

namespace {

constexpr std::size_t checksum_bytes = 8;

std::uint64_t own_checksum(const GroundHeader& header) {
    return checksum_of(std::as_bytes(std::span(&header, 1)).first(offsetof(GroundHeader, checksum)));
}

template <class Part>
std::uint64_t part_checksum(const Part& part) {
    return checksum_of(std::as_bytes(std::span(&part, 1)));
}

StoredMapSystem stored(const models::heights::CoordinateSystem& system) {
    StoredMapSystem result;
    if (system.wkt.size() <= result.wkt.size()) {
        result.centre_x = system.centre_x;
        result.centre_y = system.centre_y;
        result.unit_m = system.unit_m;
        result.wkt_length = static_cast<std::uint32_t>(system.wkt.size());
        std::copy(system.wkt.begin(), system.wkt.end(), result.wkt.begin());
    }
    return result;
}

bool is_power_of_two(double x) {
    int exponent = 0;
    return std::frexp(x, &exponent) == 0.5;
}

/// Whether |x| is at most `largest`; false for a NaN.
bool lies_within(double x, double largest) { return std::abs(x) <= largest; }

bool is_intact(const StoredMapSystem& s) {
    return std::isfinite(s.centre_x) && std::isfinite(s.centre_y) && s.wkt_length <= s.wkt.size() &&
           (s.wkt_length == 0 || (s.unit_m > 0.0 && std::isfinite(s.unit_m)));
}

bool is_intact(const StoredDeviation& d) { return std::isfinite(d.rms_m) && std::isfinite(d.worst_m) && d.places >= 0; }

bool is_intact(const GroundHeader& h) {
    const auto fits = [](std::int32_t n) { return n >= 2 && n <= 65536; };
    const bool has_numbers = std::isfinite(h.lowest_m) && std::isfinite(h.highest_m) && std::isfinite(h.mean_m) &&
                             std::isfinite(h.progress.lowest_m) && std::isfinite(h.progress.highest_m);
    const bool lies_on_earth =
        h.has_place == 0 || (lies_within(h.latitude_deg, 90.0) && lies_within(h.longitude_deg, 360.0));
    return fits(h.columns) && fits(h.rows) && is_storable(shape_of(h)) && has_numbers && lies_on_earth &&
           is_intact(h.system) && is_intact(h.deviation) && h.name_length <= h.name.size() &&
           h.progress.stage <= ImportProgress::Stage::Complete;
}

/// Whether the quadtree's square has no samples beyond the field.
bool is_square_field(const GroundShape& shape) {
    return shape.columns == shape.rows && GroundLayout(shape).level(0).edge == shape.columns - 1;
}

/// The length of the longest beginning of a text that has at most `longest` bytes and ends with a whole character.
std::size_t truncated_length(std::string_view text, std::size_t longest) {
    std::size_t length = 0;
    while (length < text.size()) {
        const std::size_t next = length + std::max(utf8_length(text.substr(length)), std::size_t{1});
        if (next > longest) { break; }
        length = next;
    }
    return length;
}

/// The text with everything replaced that is not valid UTF-8 or is a control character.
std::string sanitized_utf8(std::string_view text) {
    constexpr std::string_view replacement = "\xEF\xBF\xBD";
    std::string out;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const auto first = static_cast<unsigned char>(text.front());
        const bool is_control = first < 0x20 || first == 0x7f;
        out += length == 0 || is_control ? replacement : text.substr(0, length);
        text.remove_prefix(std::max(length, std::size_t{1}));
    }
    return out;
}

} // namespace

GroundFileLayout::GroundFileLayout(const GroundLayout& layout) {
    for (int level = 0; level < layout.levels(); ++level) {
        const GroundLayout::Level& at = layout.level(level);
        tiles += static_cast<std::size_t>(at.tiles_across) * static_cast<std::size_t>(at.tiles_up);
    }
    checksums = (GroundHeader::bytes + layout.total_bytes() + checksum_bytes - 1) / checksum_bytes * checksum_bytes;
    file_bytes = checksums + checksum_bytes * (tiles + 1);
    const std::size_t page = GroundLayout::page_bytes;
    numbers = (file_bytes + page - 1) / page * page;
}

std::uint64_t hash_of(const GroundShape& shape) {
    const GroundLayout layout(shape);
    Hash hash;
    for (int level = 0; level < layout.levels(); ++level) {
        const GroundLayout::Level& at = layout.level(level);
        for (const std::size_t place : {at.tile_nodes, at.tile_bytes, at.first_tile, at.north_heights,
                 at.north_errors[0], at.east_heights, at.east_errors[0], at.ranges}) {
            hash.add_word(place);
        }
        if (layout.has_both_margins()) {
            hash.add_word(at.errors[1][0]);
            hash.add_word(at.errors[1][1]);
            hash.add_word(at.north_errors[1]);
            hash.add_word(at.east_errors[1]);
        }
    }
    const terrain::ErrorCodes codes = terrain::codes_of(shape);
    for (int code = 0; code < 256; ++code) {
        hash.add_word(std::bit_cast<std::uint32_t>(codes.metres(static_cast<std::uint8_t>(code))));
    }
    return hash.value();
}

GroundHeader header_of(const GroundShape& shape, const GroundMetadata& metadata) {
    GroundHeader header;
    header.version = !shape.has_both_margins ? GroundHeader::version_3
                     : !shape.has_unit_codes ? GroundHeader::version_4
                                             : GroundHeader::current_version;
    header.columns = shape.columns;
    header.rows = shape.rows;
    header.spacing_m = shape.spacing_m;
    header.height_base_m = shape.height_base_m;
    header.height_unit_m = shape.height_unit_m;
    header.has_place = metadata.place ? 1 : 0;
    header.latitude_deg = metadata.place ? metadata.place->latitude_deg : 0.0;
    header.longitude_deg = metadata.place ? metadata.place->longitude_deg : 0.0;
    if (metadata.system) { header.system = stored(*metadata.system); }
    if (metadata.deviation) {
        header.deviation = {metadata.deviation->rms_m, metadata.deviation->worst_m, metadata.deviation->places};
    }
    header.filled_voids = metadata.filled_voids;
    header.lowest_m = metadata.lowest_m;
    header.highest_m = metadata.highest_m;
    header.mean_m = metadata.mean_m;
    header.name_length = static_cast<std::uint32_t>(truncated_length(metadata.name, header.name.size()));
    std::copy_n(metadata.name.begin(), header.name_length, header.name.begin());
    header.layout = hash_of(shape);
    return header;
}

GroundShape shape_of(const GroundHeader& h) {
    return {h.columns, h.rows, h.spacing_m, h.height_base_m, h.height_unit_m, h.version > GroundHeader::version_3,
        h.version > GroundHeader::version_4};
}

GroundMetadata metadata_of(const GroundHeader& h) {
    GroundMetadata metadata;
    metadata.name = sanitized_utf8({h.name.data(), h.name_length});
    if (h.has_place != 0) { metadata.place = GeoPosition{h.latitude_deg, h.longitude_deg}; }
    if (h.system.wkt_length > 0) {
        metadata.system = models::heights::CoordinateSystem{
            {h.system.wkt.data(), h.system.wkt_length}, h.system.centre_x, h.system.centre_y, h.system.unit_m};
    }
    if (metadata.place && metadata.system) {
        metadata.place->ellipsoid = models::heights::ellipsoid_of(metadata.system->wkt);
    }
    if (h.deviation.places > 0) {
        metadata.deviation =
            models::heights::HeightDeviation{h.deviation.rms_m, h.deviation.worst_m, h.deviation.places};
    }
    metadata.filled_voids = h.filled_voids;
    metadata.lowest_m = h.lowest_m;
    metadata.highest_m = h.highest_m;
    metadata.mean_m = h.mean_m;
    return metadata;
}

bool is_storable(const GroundShape& shape) {
    const double unit_m = shape.height_unit_m;
    return shape.spacing_m >= 1e-3 && shape.spacing_m <= 1e6 && lies_within(shape.height_base_m, 1e5) &&
           unit_m >= 0x1p-12 && unit_m <= 1.0 && is_power_of_two(unit_m);
}

std::array<std::byte, GroundHeader::bytes> header_page(GroundHeader header) {
    header.checksum = own_checksum(header);
    header.system_checksum = part_checksum(header.system);
    header.deviation_checksum = part_checksum(header.deviation);
    std::array<std::byte, GroundHeader::bytes> page = {};
    std::memcpy(page.data(), &header, sizeof header);
    return page;
}

GroundHeader read_header(const std::filesystem::path& path, std::span<const std::byte> file) {
    GroundHeader header;
    const bool whole = file.size() >= GroundHeader::bytes;
    if (whole) { std::memcpy(&header, file.data(), sizeof header); }
    if (!whole || header.magic != GroundHeader::current_magic) {
        throw_error_in(path, "expected a ground made by terrain import, got another kind of file");
    }
    if (header.version < GroundHeader::version_1 || header.version > GroundHeader::current_version) {
        throw_error_in(path, fmt::format("expected a ground of version {} to {}, got version {}: import it again",
                                 GroundHeader::version_1, GroundHeader::current_version, header.version));
    }
    if (header.version == GroundHeader::version_1) {
        header.system = {};
        header.system_checksum = part_checksum(header.system);
    }
    if (header.version <= GroundHeader::version_2) {
        header.deviation = {};
        header.deviation_checksum = part_checksum(header.deviation);
    }
    if (header.checksum != own_checksum(header) || header.system_checksum != part_checksum(header.system) ||
        header.deviation_checksum != part_checksum(header.deviation) || !is_intact(header)) {
        throw_error_in(path, "expected a sound header, got a damaged one: import it again");
    }
    if (header.version <= GroundHeader::version_5 && !is_square_field(shape_of(header))) {
        throw_error_in(
            path, fmt::format("expected a ground of version {}, got version {}, whose heights end otherwise at "
                              "the map's border: import it again",
                      GroundHeader::current_version, header.version));
    }
    if (header.layout != hash_of(shape_of(header))) {
        throw_error_in(path, "expected today's layout, got that of another release: import it again");
    }
    return header;
}

} // namespace octant::visuals::groundfile
