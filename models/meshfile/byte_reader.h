#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

namespace octant::models::meshfile {

/// Numbers out of the bytes of a file, front to back.
class ByteReader {
public:
    /// Keeps a view into `bytes`.
    ByteReader(const std::filesystem::path& path, std::string_view bytes, std::size_t at = 0,
        std::endian order = std::endian::little)
        : path_(path), bytes_(bytes), at_(at), order_(order) {}

    std::size_t at() const { return at_; }

    std::size_t bytes_left() const { return bytes_.size() - at_; }

    /// A number of type T. Throws Error at the end of the file.
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

    /// The next `count` bytes. Throws Error when there are fewer.
    std::string_view take(std::size_t count, const char* what);

    /// Throws Error "file: at byte N: expected ..., got ...", N being the next byte, or `at`.
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
