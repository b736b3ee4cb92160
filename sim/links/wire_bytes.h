#pragma once

#include <glm/vec3.hpp>

#include <bit>
#include <concepts>
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
        std::uint64_t whole = 0;
        for (std::size_t i = 0; i < sizeof(Number); ++i) {
            const std::size_t byte = order_ == ByteOrder::Big ? i : sizeof(Number) - 1 - i;
            whole = whole << 8U | std::to_integer<std::uint64_t>(bytes_[offset + byte]);
        }
        if constexpr (std::same_as<Number, double>) {
            return std::bit_cast<double>(whole);
        } else if constexpr (std::same_as<Number, float>) {
            return std::bit_cast<float>(static_cast<std::uint32_t>(whole));
        } else {
            return static_cast<Number>(whole);
        }
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
        std::uint64_t whole = 0;
        if constexpr (std::same_as<Number, double>) {
            whole = std::bit_cast<std::uint64_t>(number);
        } else if constexpr (std::same_as<Number, float>) {
            whole = std::bit_cast<std::uint32_t>(number);
        } else {
            whole = static_cast<std::uint64_t>(number);
        }
        for (std::size_t i = 0; i < sizeof(Number); ++i) {
            const std::size_t byte = order_ == ByteOrder::Big ? sizeof(Number) - 1 - i : i;
            bytes_[offset + byte] = static_cast<std::byte>(whole >> (8U * i) & 0xffU);
        }
    }

    std::size_t size() const { return bytes_.size(); }

    Bytes bytes() const { return bytes_; }

    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    ByteOrder order_;
    std::vector<std::byte> bytes_;
};

} // namespace octant::sim::links
