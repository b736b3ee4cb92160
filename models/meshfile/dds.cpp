// Layout: "DDS " and a header of 124 bytes, perhaps one more of 20 bytes for the formats of DirectX 10, then the
// levels. Blocks of 4 x 4 texels as in Khronos Data Format Specification 1.3, chapter 18 (S3TC) and 19 (RGTC).
#include "models/meshfile/dds.h"

#include "sim/base/binary_file.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <utility>

namespace octant::models::meshfile {

namespace {

constexpr std::string_view dds_signature = "DDS ";
constexpr std::size_t dds_header_bytes = 128;
constexpr std::size_t dx10_bytes = 20;
constexpr std::uint32_t max_dds_side = 16384;

enum class Coding { Bc1, Bc2, Bc3, Bc4, Bc5, Plain };

/// How the pixels of a file are coded.
struct Layout {
    Coding coding = Coding::Plain;
    unsigned bits = 32;                                            ///< a pixel, where it is not compressed
    std::array<std::uint32_t, 4> masks{0xff0000, 0xff00, 0xff, 0}; ///< of red, green, blue and alpha, likewise
};

using Texel = std::array<std::uint8_t, 4>;
using Block = std::array<Texel, 16>;

constexpr std::uint32_t code(std::string_view letters) {
    std::uint32_t number = 0;
    for (unsigned i = 0; i < 4; ++i) {
        number |= static_cast<std::uint32_t>(static_cast<unsigned char>(letters[i])) << (8U * i);
    }
    return number;
}

[[noreturn]] void refuse_format(const std::string& name, const std::string& got) {
    throw Error(fmt::format("{}: expected a DDS picture of BC1 to BC5 or of plain pixels, got {}", name, got));
}

/// By its number in the header of DirectX 10 (DXGI_FORMAT).
Layout layout_of_number(const std::string& name, std::uint32_t number) {
    if (number >= 70 && number <= 72) { return {Coding::Bc1, 0, {}}; }
    if (number >= 73 && number <= 75) { return {Coding::Bc2, 0, {}}; }
    if (number >= 76 && number <= 78) { return {Coding::Bc3, 0, {}}; }
    if (number == 79 || number == 80) { return {Coding::Bc4, 0, {}}; }
    if (number == 82 || number == 83) { return {Coding::Bc5, 0, {}}; }
    if (number >= 27 && number <= 29) { return {Coding::Plain, 32, {0xff, 0xff00, 0xff0000, 0xff000000}}; }
    if (number == 87 || number == 91) { return {Coding::Plain, 32, {0xff0000, 0xff00, 0xff, 0xff000000}}; }
    if (number == 88 || number == 93) { return {Coding::Plain, 32, {0xff0000, 0xff00, 0xff, 0}}; }
    refuse_format(name, fmt::format("format {}", number));
}

Layout layout_of(const std::string& name, std::string_view bytes) {
    constexpr std::uint32_t has_alpha = 1;
    constexpr std::uint32_t has_code = 4;
    constexpr std::uint32_t is_grey = 0x20000;
    const auto number = [&](std::size_t at) { return value_at<std::uint32_t>(bytes.data() + at); };
    const std::uint32_t flags = number(80);
    if ((flags & has_code) != 0) {
        const std::uint32_t letters = number(84);
        constexpr std::array<std::pair<std::string_view, Coding>, 9> known{{{"DXT1", Coding::Bc1},
            {"DXT2", Coding::Bc2}, {"DXT3", Coding::Bc2}, {"DXT4", Coding::Bc3}, {"DXT5", Coding::Bc3},
            {"ATI1", Coding::Bc4}, {"BC4U", Coding::Bc4}, {"ATI2", Coding::Bc5}, {"BC5U", Coding::Bc5}}};
        for (const auto& [word, coding] : known) {
            if (letters == code(word)) { return {coding, 0, {}}; }
        }
        if (letters == code("DX10") && bytes.size() >= dds_header_bytes + dx10_bytes) {
            return layout_of_number(name, number(dds_header_bytes));
        }
        refuse_format(name, in_quotes(bytes.substr(84, 4)));
    }
    Layout layout;
    layout.bits = number(88);
    for (std::size_t part = 0; part < 4; ++part) { layout.masks.at(part) = number(92 + 4 * part); }
    if ((flags & is_grey) != 0) { layout.masks[1] = layout.masks[2] = layout.masks[0]; }
    if ((flags & has_alpha) == 0) { layout.masks[3] = 0; }
    if (layout.bits == 0 || layout.bits > 32 || layout.bits % 8 != 0) {
        refuse_format(name, fmt::format("{} bits a pixel", layout.bits));
    }
    return layout;
}

/// The bits of a mask, spread to 8 bits; 255 for none.
std::uint8_t masked(std::uint32_t pixel, std::uint32_t mask) {
    if (mask == 0) { return 255; }
    const std::uint32_t most = mask >> std::countr_zero(mask);
    const std::uint64_t value = (pixel & mask) >> std::countr_zero(mask);
    return static_cast<std::uint8_t>((value * 255U + most / 2U) / most);
}

Texel from_565(std::uint32_t packed) {
    return {masked(packed, 0xf800), masked(packed, 0x07e0), masked(packed, 0x001f), 255};
}

Texel mixed(const Texel& a, const Texel& b, unsigned of_a, unsigned of_b) {
    Texel mean{0, 0, 0, 255};
    for (std::size_t part = 0; part < 3; ++part) {
        mean.at(part) = static_cast<std::uint8_t>((of_a * a.at(part) + of_b * b.at(part)) / (of_a + of_b));
    }
    return mean;
}

/// The colours of 8 bytes. `has_holes`: where the first colour is not the greater one, one of four is transparent.
void read_colours(const char* from, bool has_holes, Block& block) {
    const auto first = value_at<std::uint16_t>(from);
    const auto second = value_at<std::uint16_t>(from + 2);
    const auto numbers = value_at<std::uint32_t>(from + 4);
    std::array<Texel, 4> palette{from_565(first), from_565(second)};
    if (has_holes && first <= second) {
        palette[2] = mixed(palette[0], palette[1], 1, 1);
        palette[3] = {0, 0, 0, 0};
    } else {
        palette[2] = mixed(palette[0], palette[1], 2, 1);
        palette[3] = mixed(palette[0], palette[1], 1, 2);
    }
    for (unsigned i = 0; i < 16; ++i) { block.at(i) = palette.at(numbers >> (2U * i) & 3U); }
}

/// Sixteen values of 8 bytes: two ends and three bits for each.
std::array<std::uint8_t, 16> ramp_values(const char* from) {
    const auto bits = value_at<std::uint64_t>(from);
    const auto first = static_cast<unsigned>(bits & 255U);
    const auto second = static_cast<unsigned>(bits >> 8U & 255U);
    std::array<unsigned, 8> ramp{first, second, 0, 0, 0, 0, 0, 255};
    const unsigned steps = first > second ? 7 : 5;
    for (unsigned i = 1; i < steps; ++i) { ramp.at(i + 1) = ((steps - i) * first + i * second) / steps; }
    std::array<std::uint8_t, 16> values{};
    for (unsigned i = 0; i < 16; ++i) {
        values.at(i) = static_cast<std::uint8_t>(ramp.at(bits >> (16U + 3U * i) & 7U));
    }
    return values;
}

Block block_at(const char* from, Coding coding) {
    Block block{};
    if (coding == Coding::Bc4) {
        const std::array<std::uint8_t, 16> values = ramp_values(from);
        for (std::size_t i = 0; i < 16; ++i) { block.at(i) = {values.at(i), values.at(i), values.at(i), 255}; }
        return block;
    }
    if (coding == Coding::Bc5) {
        const std::array<std::uint8_t, 16> red = ramp_values(from);
        const std::array<std::uint8_t, 16> green = ramp_values(from + 8);
        for (std::size_t i = 0; i < 16; ++i) { block.at(i) = {red.at(i), green.at(i), 0, 255}; }
        return block;
    }
    read_colours(coding == Coding::Bc1 ? from : from + 8, coding == Coding::Bc1, block);
    if (coding == Coding::Bc2) {
        const auto bits = value_at<std::uint64_t>(from);
        for (unsigned i = 0; i < 16; ++i) {
            block.at(i)[3] = static_cast<std::uint8_t>((bits >> (4U * i) & 15U) * 17U);
        }
    } else if (coding == Coding::Bc3) {
        const std::array<std::uint8_t, 16> values = ramp_values(from);
        for (std::size_t i = 0; i < 16; ++i) { block.at(i)[3] = values.at(i); }
    }
    return block;
}

void unpack_blocks(const char* from, Coding coding, TextureLevel& level) {
    const std::size_t block_bytes = coding == Coding::Bc1 || coding == Coding::Bc4 ? 8 : 16;
    for (int top = 0; top < level.height; top += 4) {
        for (int left = 0; left < level.width; left += 4, from += block_bytes) {
            const Block block = block_at(from, coding);
            for (int row = 0; row < std::min(4, level.height - top); ++row) {
                for (int column = 0; column < std::min(4, level.width - left); ++column) {
                    const std::size_t to = static_cast<std::size_t>(top + row) * static_cast<std::size_t>(level.width) +
                                           static_cast<std::size_t>(left + column);
                    std::ranges::copy(block.at(static_cast<std::size_t>(4 * row + column)), &level.rgba[4 * to]);
                }
            }
        }
    }
}

void unpack_pixels(const char* from, const Layout& layout, TextureLevel& level) {
    for (std::size_t at = 0; at < level.rgba.size(); at += 4, from += layout.bits / 8) {
        std::uint32_t pixel = 0;
        for (unsigned byte = 0; byte < layout.bits / 8; ++byte) {
            pixel |= static_cast<std::uint32_t>(static_cast<unsigned char>(from[byte])) << (8U * byte);
        }
        for (std::size_t part = 0; part < 4; ++part) { level.rgba[at + part] = masked(pixel, layout.masks.at(part)); }
    }
}

} // namespace

bool is_dds(std::string_view bytes) { return bytes.starts_with(dds_signature); }

TextureLevel dds_level(const std::string& name, std::string_view bytes) {
    if (!is_dds(bytes) || bytes.size() < dds_header_bytes) {
        throw Error(fmt::format("{}: expected a DDS header of {} bytes, got {}", name, dds_header_bytes, bytes.size()));
    }
    const auto height = value_at<std::uint32_t>(bytes.data() + 12);
    const auto width = value_at<std::uint32_t>(bytes.data() + 16);
    if (width == 0 || height == 0 || width > max_dds_side || height > max_dds_side) {
        throw Error(fmt::format("{}: expected 1 to {} texels a side, got {} x {}", name, max_dds_side, width, height));
    }
    const Layout layout = layout_of(name, bytes);
    const bool has_more = (value_at<std::uint32_t>(bytes.data() + 80) & 4U) != 0 &&
                          value_at<std::uint32_t>(bytes.data() + 84) == code("DX10");
    const std::string_view pixels = bytes.substr(dds_header_bytes + (has_more ? dx10_bytes : 0));
    const bool is_half = layout.coding == Coding::Bc1 || layout.coding == Coding::Bc4;
    const std::size_t wanted = layout.coding == Coding::Plain
                                   ? std::size_t{width} * height * (layout.bits / 8)
                                   : std::size_t{(width + 3) / 4} * ((height + 3) / 4) * (is_half ? 8 : 16);
    if (pixels.size() < wanted) {
        throw Error(fmt::format("{}: expected {} bytes of pixels, got {}", name, wanted, pixels.size()));
    }
    TextureLevel level{static_cast<int>(width), static_cast<int>(height), {}};
    level.rgba.resize(std::size_t{4} * width * height);
    if (layout.coding == Coding::Plain) {
        unpack_pixels(pixels.data(), layout, level);
    } else {
        unpack_blocks(pixels.data(), layout.coding, level);
    }
    return level;
}

} // namespace octant::models::meshfile
