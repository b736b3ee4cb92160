#include "models/meshfile/binary_file.h"

#include "sim/base/error.h"

#include <cstddef>
#include <cstdint>
#include <fmt/format.h>

namespace octant::models::meshfile {

namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

int value_of(char c) {
    if (c >= 'A' && c <= 'Z') { return c - 'A'; }
    if (c >= 'a' && c <= 'z') { return c - 'a' + 26; }
    if (c >= '0' && c <= '9') { return c - '0' + 52; }
    return c == '+' ? 62 : (c == '/' ? 63 : -1);
}

} // namespace

std::string base64_text(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = bytes.size() - at < 3 ? bytes.size() - at : 3;
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const char byte = i < count ? bytes[at + i] : '\0';
            group = group << 8U | static_cast<unsigned char>(byte);
        }
        for (std::size_t i = 0; i < 4; ++i) { text += i <= count ? digits[group >> (18U - 6U * i) & 63U] : '='; }
    }
    return text;
}

std::optional<std::string> base64_bytes(std::string_view text) {
    for (int marks = 0; marks < 2 && text.ends_with('='); ++marks) { text.remove_suffix(1); }
    if (text.size() % 4 == 1) { return std::nullopt; }
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t group = 0;
    unsigned bits = 0;
    for (const char c : text) {
        const int value = value_of(c);
        if (value < 0) { return std::nullopt; }
        group = group << 6U | static_cast<std::uint32_t>(value);
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes += static_cast<char>(group >> bits & 255U);
        }
    }
    return bytes;
}

std::string_view ByteReader::take(std::size_t count, const char* what) {
    if (bytes_left() < count) {
        refuse(fmt::format("{} ({} bytes)", what, count), fmt::format("{} to the end of the file", bytes_left()));
    }
    at_ += count;
    return bytes_.substr(at_ - count, count);
}

void ByteReader::refuse_at(std::size_t at, const std::string& expected, const std::string& got) const {
    throw_error_in(path_, fmt::format("at byte {}: expected {}, got {}", at, expected, got));
}

} // namespace octant::models::meshfile
