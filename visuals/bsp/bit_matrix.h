#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::bsp {

/// A square of bits, 64 to a word.
class BitMatrix {
public:
    explicit BitMatrix(std::size_t count)
        : words_((count + 63) / 64)
        , bits_(words_ * 64 * words_, 0) {}

    std::size_t words() const { return words_; }

    std::uint64_t& word(std::size_t row, std::size_t word) { return bits_[row * words_ + word]; }

    void add(std::size_t row, std::size_t column) {
        word(row, column / 64) |= std::uint64_t{1} << (column % 64);
    }

    void remove(std::size_t row, std::size_t column) {
        word(row, column / 64) &= ~(std::uint64_t{1} << (column % 64));
    }

    /// Rows become columns, block by block.
    void transpose() {
        for (std::size_t row = 0; row < words_; ++row) {
            for (std::size_t column = 0; column <= row; ++column) {
                const Block lower = transposed_block(row, column);
                put(column, row, transposed_block(column, row), lower);
            }
        }
    }

private:
    using Block = std::array<std::uint64_t, 64>;

    /// A block of 64 rows and columns, transposed by halves, quarters and so on.
    Block transposed_block(std::size_t row, std::size_t column) {
        Block block;
        for (std::size_t i = 0; i < 64; ++i) {
            block[i] = word(row * 64 + i, column);
        }
        std::uint64_t mask = 0xffffffffU;
        for (unsigned width = 32; width != 0; width /= 2, mask ^= mask << width) {
            for (unsigned i = 0; i < 64; i = (i + width + 1) & ~width) {
                const std::uint64_t swapped = ((block[i] >> width) ^ block[i + width]) & mask;
                block[i] ^= swapped << width;
                block[i + width] ^= swapped;
            }
        }
        return block;
    }

    /// Writes two blocks that have changed places.
    void put(std::size_t row, std::size_t column, const Block& across, const Block& here) {
        for (std::size_t i = 0; i < 64; ++i) {
            word(column * 64 + i, row) = across[i];
            word(row * 64 + i, column) = here[i];
        }
    }

    std::size_t words_;
    std::vector<std::uint64_t> bits_; ///< Rows in multiples of 64.
};

} // namespace octant::visuals::bsp
