#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace octant::visuals::refine {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

/// Appends numbers and texts to a string of bytes, little-endian.
class VarintWriter {
public:
    template <class Number>
    void put(const Number& number) {
        static_assert(std::is_trivially_copyable_v<Number>);
        char bytes[sizeof(Number)];
        std::memcpy(bytes, &number, sizeof(Number));
        bytes_.append(bytes, sizeof(Number));
    }

    /// Writes an unsigned number in 7 bits a byte, the lowest bits first (LEB128), so that small numbers take one byte.
    void put_varint(std::uint64_t number) {
        while (number >= 128) {
            bytes_.push_back(static_cast<char>(number % 128 + 128));
            number /= 128;
        }
        bytes_.push_back(static_cast<char>(number));
    }

    /// Writes `number` - `from`, which may be negative, with the sign in the lowest bit (zigzag coding) and then as
    /// put_varint does.
    void put_delta(std::uint32_t number, std::uint32_t from) {
        const std::int64_t difference = static_cast<std::int64_t>(number) - static_cast<std::int64_t>(from);
        put_varint(static_cast<std::uint64_t>(difference < 0 ? -2 * difference - 1 : 2 * difference));
    }

    void put_text(std::string_view text) {
        put_varint(text.size());
        bytes_.append(text);
    }

    std::string& bytes() { return bytes_; }

private:
    std::string bytes_;
};

/// Reads what VarintWriter wrote. It never reads beyond the end: what is asked for there is 0, and good() is false from
/// then on, so that callers may check once after several reads.
class VarintReader {
public:
    explicit VarintReader(std::string_view bytes) : bytes_(bytes) {}

    template <class Number>
    Number take() {
        static_assert(std::is_trivially_copyable_v<Number>);
        Number number{};
        if (bytes_.size() < sizeof(Number)) {
            fail();
            return number;
        }
        std::memcpy(&number, bytes_.data(), sizeof(Number));
        bytes_.remove_prefix(sizeof(Number));
        return number;
    }

    std::uint64_t take_varint() {
        std::uint64_t number = 0;
        for (unsigned shift = 0; shift < 63; shift += 7) {
            const auto byte = take<std::uint8_t>();
            number |= static_cast<std::uint64_t>(byte & 127U) << shift;
            if (byte < 128) { return number; }
        }
        fail();
        return 0;
    }

    /// As take_varint; numbers that need more than 32 bits are an error.
    std::uint32_t take_varint32() {
        const std::uint64_t number = take_varint();
        if (number > 0xffffffffU) {
            fail();
            return 0;
        }
        return static_cast<std::uint32_t>(number);
    }

    std::uint32_t take_delta(std::uint32_t from) {
        const std::uint64_t coded = take_varint();
        const auto half = static_cast<std::int64_t>(coded / 2);
        const std::int64_t number = static_cast<std::int64_t>(from) + (coded % 2 == 0 ? half : -half - 1);
        if (number < 0 || number > 0xffffffff) {
            fail();
            return 0;
        }
        return static_cast<std::uint32_t>(number);
    }

    std::string take_text() {
        const std::uint64_t size = take_varint();
        if (size > bytes_.size()) {
            fail();
            return {};
        }
        std::string text(bytes_.substr(0, size));
        bytes_.remove_prefix(size);
        return text;
    }

    bool good() const { return good_; }

    std::size_t left() const { return bytes_.size(); }

private:
    void fail() {
        good_ = false;
        bytes_ = {};
    }

    std::string_view bytes_;
    bool good_ = true;
};

} // namespace octant::visuals::refine
