#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace octant::models::meshfile {

/// Encodes bytes as base64 with padding.
std::string base64_text(std::string_view bytes);

/// Decodes base64, with or without padding. Nothing for invalid text.
std::optional<std::string> base64_bytes(std::string_view text);

/// Appends a number to the bytes of a file, little endian.
template <typename T>
void append_number(std::string& bytes, T value) {
    auto own = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) { std::ranges::reverse(own); }
    bytes.append(own.data(), own.size());
}

/// Reads numbers from the bytes of a file, front to back.
class ByteReader {
public:
    /// Keeps a view into `bytes`.
    ByteReader(const std::filesystem::path& path, std::string_view bytes, std::size_t at = 0,
        std::endian order = std::endian::little)
        : path_(path), bytes_(bytes), at_(at), order_(order) {}

    std::size_t at() const { return at_; }

    std::size_t bytes_left() const { return bytes_.size() - at_; }

    /// Reads a number of type T. `what` names it in messages. Throws Error at the end of the file.
    template <typename T>
    T number(const char* what) {
        const std::string_view from = take(sizeof(T), what);
        char own[sizeof(T)];
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            own[i] = order_ == std::endian::native ? from[i] : from[sizeof(T) - 1 - i];
        }
        T value;
        std::memcpy(&value, own, sizeof(T));
        return value;
    }

    /// Reads the next `count` bytes. Throws Error if there are fewer.
    std::string_view take(std::size_t count, const char* what);

    /// Throws Error "file: at byte N: expected ..., got ...", where N is the next byte or `at`.
    [[noreturn]] void refuse(const std::string& expected, const std::string& got) const {
        refuse_at(at_, expected, got);
    }

    [[noreturn]] void refuse_at(std::size_t at, const std::string& expected, const std::string& got) const;

private:
    std::filesystem::path path_;
    std::string_view bytes_;
    std::size_t at_ = 0;
    std::endian order_ = std::endian::little;
};

} // namespace octant::models::meshfile
