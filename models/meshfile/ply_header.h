#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

std::size_t bytes_of(PlyType type);

/// What stands for a colour part of 1: the largest of a whole-number type; 1 for float and double.
double normalization_divisor(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::f32;
    bool is_list = false;
    PlyType count_type = PlyType::u8; ///< of a list
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };

struct PlyHeader {
    PlyEncoding form = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::size_t body_at = 0; ///< byte behind the header
    int body_line = 1;
};

/// The header of a PLY file, checked for what its body can hold at most. Throws Error "file:line".
PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view bytes);

} // namespace octant::models::meshfile
