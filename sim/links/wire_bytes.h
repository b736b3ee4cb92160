#pragma once

#include "sim/base/binary_file.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace octant::sim::links {

using Bytes = std::span<const std::byte>;

enum class ByteOrder { Big, Little };

/// Reads numbers of a packet wherever they stand. A number that does not lie within the packet reads as 0: decoders
/// check lengths before, and a mistake of theirs reads no other memory.
class WireReader {
public:
    WireReader(Bytes bytes, ByteOrder order) : bytes_(bytes), order_(order) {}

    /// Integers and floating-point numbers of 1, 2, 4 or 8 bytes.
    template <class Number>
    Number at(std::size_t offset) const {
        static_assert(std::is_arithmetic_v<Number>);
        if (offset > bytes_.size() || bytes_.size() - offset < sizeof(Number)) { return {}; }
        return value_at<Number>(reinterpret_cast<const char*>(bytes_.data()) + offset,
            order_ == ByteOrder::Big ? std::endian::big : std::endian::little);
    }

    /// Three numbers of 4 bytes one behind the other.
    glm::dvec3 floats(std::size_t offset) const {
        return {static_cast<double>(at<float>(offset)), static_cast<double>(at<float>(offset + 4)),
            static_cast<double>(at<float>(offset + 8))};
    }

    std::size_t size() const { return bytes_.size(); }

private:
    Bytes bytes_;
    ByteOrder order_;
};

/// Writes numbers behind each other, or over what stands there already.
class WireWriter {
public:
    explicit WireWriter(ByteOrder order) : order_(order) {}

    template <class Number>
    void add(Number number) {
        bytes_.resize(bytes_.size() + sizeof(Number));
        set(bytes_.size() - sizeof(Number), number);
    }

    void add_zeros(std::size_t count) { bytes_.resize(bytes_.size() + count); }

    /// The number must fit into what was added so far; else nothing is written.
    template <class Number>
    void set(std::size_t offset, Number number) {
        static_assert(std::is_arithmetic_v<Number>);
        if (offset > bytes_.size() || bytes_.size() - offset < sizeof(Number)) { return; }
        auto own = std::bit_cast<std::array<std::byte, sizeof(Number)>>(number);
        if (order_ == ByteOrder::Big) { std::ranges::reverse(own); }
        std::ranges::copy(own, bytes_.begin() + static_cast<std::ptrdiff_t>(offset));
    }

    std::size_t size() const { return bytes_.size(); }

    Bytes bytes() const { return bytes_; }

    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    ByteOrder order_;
    std::vector<std::byte> bytes_;
};

} // namespace octant::sim::links
