#include "whole_metres_tiff.h"

#include <array>
#include <cstddef>
#include <fstream>
#include <vector>

namespace octant::visuals::groundfile {

namespace {

/// A tag of a TIFF directory whose value is one number or lies elsewhere.
struct Tag {
    std::uint16_t tag;
    std::uint16_t type; ///< 3 short, 4 long, 12 double
    std::uint32_t count;
    std::uint32_t value;
};

static_assert(sizeof(Tag) == 12);

template <typename Values>
void put(std::ofstream& stream, const Values& values) {
    const auto bytes = std::as_bytes(std::span(values));
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

} // namespace

void write_geotiff(const std::filesystem::path& file, int columns, std::span<const std::int16_t> heights_m,
    double spacing_m, glm::dvec2 corner_m) {
    constexpr std::uint32_t tag_count = 12;
    constexpr std::uint32_t scale_at = 10 + 12 * tag_count + 4;
    constexpr std::uint32_t tie_at = scale_at + 3 * 8;
    constexpr std::uint32_t strip_at = tie_at + 6 * 8;
    const auto width = static_cast<std::uint32_t>(columns);
    const auto height = static_cast<std::uint32_t>(heights_m.size()) / width;
    const auto bytes = static_cast<std::uint32_t>(heights_m.size_bytes());
    const std::array<Tag, tag_count> tags = {{{256, 4, 1, width}, {257, 4, 1, height}, {258, 3, 1, 16}, {259, 3, 1, 1},
        {262, 3, 1, 1}, {273, 4, 1, strip_at}, {277, 3, 1, 1}, {278, 4, 1, height}, {279, 4, 1, bytes}, {339, 3, 1, 2},
        {33550, 12, 3, scale_at}, {33922, 12, 6, tie_at}}};
    std::ofstream stream(file, std::ios::binary);
    put(stream, std::array<std::uint16_t, 5>{0x4949, 42, 8, 0, tag_count});
    put(stream, tags);
    put(stream, std::array<std::uint32_t, 1>{0});
    put(stream, std::array<double, 3>{spacing_m, spacing_m, 0.0});
    put(stream, std::array<double, 6>{0.0, 0.0, 0.0, corner_m.x, corner_m.y, 0.0});
    put(stream, heights_m);
}

} // namespace octant::visuals::groundfile
