#pragma once

#include "models/heights/height_field_export.h"
#include "tests/scratch.h"
#include "visuals/groundfile/ground_import.h"
#include "visuals/groundfile/ground_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

// An imported ground and what may befall its file, for tests of whoever reads such files.
namespace octant::tests {

inline constexpr int wave_columns = 300;
inline constexpr int wave_rows = 200;

/// Waves of 400 m height and 3 km length, whose finest samples lie within 2 m of their neighbours' means.
inline models::heights::HeightField waves() {
    std::vector<float> heights_m;
    for (int row = 0; row < wave_rows; ++row) {
        for (int column = 0; column < wave_columns; ++column) {
            heights_m.push_back(
                static_cast<float>(std::lround(400.0 * std::sin(0.06 * column) * std::cos(0.05 * row))));
        }
    }
    return {wave_columns, wave_rows, 30.0, heights_m};
}

/// The bytes of the waves' imported ground.
inline const std::string& sound_ground() {
    static const std::string bytes = [] {
        using namespace visuals::groundfile;
        const std::filesystem::path tiff = scratch_folder() / "waves.tif";
        const std::filesystem::path ground = scratch_folder() / "waves.ground";
        models::heights::write_height_field(tiff, waves());
        import_ground({tiff}, ground, {}, [](ImportStage, double) { return false; });
        std::ifstream in(ground, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    }();
    return bytes;
}

/// Numbers from a seed, the same everywhere.
class Numbers {
public:
    explicit Numbers(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15U + 1) {}

    std::size_t below(std::size_t end) {
        state_ ^= state_ << 13U;
        state_ ^= state_ >> 7U;
        state_ ^= state_ << 17U;
        return static_cast<std::size_t>(state_ % end);
    }

private:
    std::uint64_t state_;
};

/// One of seven kinds of damage: a bit, a byte, noise, zeros, a part of the file in another's place, a cut, an end that
/// is not its own.
inline std::string damaged(std::string bytes, Numbers& numbers) {
    const std::size_t kind = numbers.below(7);
    const std::size_t at = numbers.below(bytes.size());
    const std::size_t length = std::min(1 + numbers.below(40000), bytes.size() - at);
    switch (kind) {
    case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << numbers.below(8)));
        break;
    case 1:
        bytes[at] = static_cast<char>(numbers.below(256));
        break;
    case 2:
        for (std::size_t i = 0; i < length; ++i) { bytes[at + i] = static_cast<char>(numbers.below(256)); }
        break;
    case 3:
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
        break;
    case 4: {
        const std::string part = bytes.substr(numbers.below(bytes.size()), length);
        bytes.replace(at, part.size(), part);
        break;
    }
    case 5:
        bytes.resize(at);
        break;
    default:
        bytes.append(length, 'x');
    }
    return bytes;
}

/// Whether damage of this file was met and is told at the end.
inline bool is_noted(const std::filesystem::path& file) {
    const std::vector<std::string> lines = visuals::groundfile::tile_damage_messages();
    return std::any_of(
        lines.begin(), lines.end(), [&](const std::string& line) { return line.starts_with(file.string() + ":"); });
}

} // namespace octant::tests
