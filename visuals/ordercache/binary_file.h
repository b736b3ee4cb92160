#pragma once

#include "sim/base/error.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace octant::visuals::ordercache {

/// Values as they stand in memory, one behind the other; arrays and texts behind their number of elements. Types must
/// have no padding, so that equal values give equal bytes.
class BinaryWriter {
public:
    template <class Value>
    requires std::is_arithmetic_v<Value>

    void number(Value value) { append(&value, sizeof value); }

    template <class Value>
    requires std::is_trivially_copyable_v<Value>

    void array(std::span<const Value> values) {
        number(std::uint64_t{values.size()});
        append(values.data(), values.size_bytes());
    }

    template <class Value>
    void array(const std::vector<Value>& values) {
        array(std::span(values));
    }

    void text(std::string_view text) { array(std::span(text)); }

    /// Bytes without their number.
    void raw(std::string_view bytes) { bytes_ += bytes; }

    const std::string& bytes() const { return bytes_; }

private:
    void append(const void* data, std::size_t size) {
        if (size > 0) { bytes_.append(static_cast<const char*>(data), size); }
    }

    std::string bytes_;
};

/// Reads what BinaryWriter has written, in the same sequence, from bytes that may be anything. Throws Error "expected
/// ..., got ..." where they end too soon.
class BinaryReader {
public:
    explicit BinaryReader(std::string_view bytes) : rest_(bytes) {}

    template <class Value>

    requires std::is_arithmetic_v<Value>

        Value number() {
        Value value{};
        std::memcpy(&value, next(1, sizeof value).data(), sizeof value);
        return value;
    }

    template <class Value>

    requires std::is_trivially_copyable_v<Value>

        std::vector<Value> array() {
        const auto count = number<std::uint64_t>();
        const std::string_view bytes = next(count, sizeof(Value));
        std::vector<Value> values(static_cast<std::size_t>(count));
        if (!bytes.empty()) { std::memcpy(values.data(), bytes.data(), bytes.size()); }
        return values;
    }

    /// A view of the bytes that are read.
    std::string_view text() {
        const auto size = number<std::uint64_t>();
        return next(size, 1);
    }

    /// A number of things that take at least `min_size` bytes each.
    std::size_t count(std::size_t min_size) {
        const auto many = number<std::uint64_t>();
        check_size(many, min_size);
        return static_cast<std::size_t>(many);
    }

    std::size_t bytes_left() const { return rest_.size(); }

private:
    void check_size(std::uint64_t many, std::size_t size) const {
        if (many > rest_.size() / size) {
            throw Error(fmt::format("expected {} times {} bytes, got {}", many, size, rest_.size()));
        }
    }

    std::string_view next(std::uint64_t many, std::size_t size) {
        check_size(many, size);
        const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(many) * size);
        rest_.remove_prefix(taken.size());
        return taken;
    }

    std::string_view rest_;
};

} // namespace octant::visuals::ordercache
