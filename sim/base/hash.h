#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string_view>

namespace octant {

/// Mixes the bits of a number: each bit of the result depends on all bits of `h`. A random number for a grid point.
constexpr std::uint32_t scrambled(std::uint32_t h) {
    h = (h ^ (h >> 16U)) * 0x7feb352dU;
    h = (h ^ (h >> 15U)) * 0x846ca68bU;
    return h ^ (h >> 16U);
}

/// The same for 64 bits.
constexpr std::uint64_t scrambled64(std::uint64_t h) {
    h = (h ^ (h >> 32U)) * 0xd6e8feb86659fd93ULL;
    h = (h ^ (h >> 29U)) * 0xa0761d6478bd642fULL;
    return h ^ (h >> 32U);
}

/// 64-bit running hash (FNV-1a over 8-byte words, a shorter end padded with zeros): fast enough for one picture per
/// frame. Not cryptographic.
class Hash {
public:
    void add(std::span<const std::byte> bytes) {
        std::size_t at = 0;
        for (; at + 8 <= bytes.size(); at += 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data() + at, 8);
            add_word(word);
        }
        if (at < bytes.size()) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data() + at, bytes.size() - at);
            add_word(word);
        }
    }

    void add_word(std::uint64_t word) {
        value_ = (value_ ^ word) * 0x100000001b3ULL;
        value_ ^= value_ >> 32U;
    }

    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

/// A faster hash for large inputs: the hash of four hashes, each of one quarter of the bytes. A processor works on the
/// four at the same time, as none needs the result of another.
inline std::uint64_t hash_by_quarters(std::span<const std::byte> bytes) {
    const std::size_t size = bytes.size() / 32 * 8; // what is left over belongs to the last quarter
    const auto word_at = [&](std::size_t at) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, 8);
        return word;
    };
    Hash first;
    Hash second;
    Hash third;
    Hash last;
    for (std::size_t at = 0; at < size; at += 8) {
        first.add_word(word_at(at));
        second.add_word(word_at(size + at));
        third.add_word(word_at(2 * size + at));
        last.add_word(word_at(3 * size + at));
    }
    last.add(bytes.subspan(4 * size));
    Hash all;
    for (const Hash& quarter : {first, second, third, last}) { all.add_word(quarter.value()); }
    return all.value();
}

/// The hash of all bytes, which files store to detect damage.
inline std::uint64_t checksum_of(std::span<const std::byte> bytes) {
    Hash hash;
    hash.add(bytes);
    return hash.value();
}

inline std::uint64_t checksum_of(std::string_view bytes) { return checksum_of(std::as_bytes(std::span(bytes))); }

} // namespace octant
