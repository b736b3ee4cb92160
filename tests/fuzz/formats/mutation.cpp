#include "tests/fuzz/formats/mutation.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace octant::tests::formats {

namespace {

constexpr std::array<std::string_view, 18> numbers{"0", "-1", "1e308", "-1e308", "nan", "inf", "1e-320", "0.5", "1e18",
    "65536", "-0", "2147483648", "-2147483649", "4294967296", "1e19", "0x10", "999999999999999999999", ""};
constexpr std::array<std::uint64_t, 12> words_of_bits{0, 1, 0xff, 0x7fff, 0x8000, 0xffff, 0x7fffffff, 0x80000000U,
    0xffffffffU, 0x7f800000, 0x7ff0000000000000, 0xffffffffffffffffU};

/// The bytes that are changed, and what decides how.
class Faults {
public:
    Faults(std::string& bytes, RandomGenerator& dice) : bytes_(bytes), dice_(dice) {}

    /// A number below `count`, which is at least 1.
    std::size_t below(std::size_t count) {
        return std::min(static_cast<std::size_t>(dice_.next() * static_cast<double>(count)), count - 1);
    }

    void flip_bit() {
        char& byte = bytes_[below(bytes_.size())];
        byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << below(8)));
    }

    void set_byte() { bytes_[below(bytes_.size())] = static_cast<char>(below(256)); }

    /// 1, 2, 4 or 8 bytes become a number at the limits of its type, of either byte order.
    void set_binary_number() {
        const std::size_t size = std::min(std::size_t{1} << below(4), bytes_.size());
        const std::size_t at = below(bytes_.size() - size + 1);
        const std::uint64_t value = words_of_bits[below(words_of_bits.size())];
        const bool big_end = below(4) == 0;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t shift = 8 * (big_end ? size - 1 - i : i);
            bytes_[at + i] = static_cast<char>((value >> shift) & 0xffU);
        }
    }

    /// The text number after a place, or nothing where there is none.
    void set_text_number() {
        const auto digits = std::string_view("+-.0123456789eE");
        const std::size_t first = bytes_.find_first_of("-0123456789", below(bytes_.size()));
        if (first != std::string::npos) {
            const std::size_t end = std::min(bytes_.find_first_not_of(digits, first), bytes_.size());
            bytes_.replace(first, end - first, numbers[below(numbers.size())]);
        }
    }

    void cut_end() { bytes_.resize(below(bytes_.size())); }

    void take_out() {
        const std::size_t at = below(bytes_.size());
        bytes_.erase(at, 1 + below(std::min<std::size_t>(bytes_.size() - at, 64)));
    }

    void double_piece() {
        const std::size_t at = below(bytes_.size());
        const std::string piece = bytes_.substr(at, 1 + below(200));
        bytes_.insert(below(bytes_.size()), piece);
    }

    void put_word(std::span<const std::string> words) {
        if (!words.empty()) {
            const std::string& word = words[below(words.size())];
            const std::size_t replaced = below(2) == 0 ? 0 : word.size();
            bytes_.replace(below(bytes_.size()), replaced, word);
        }
    }

    void swap_lines() {
        const auto line_at = [&](std::size_t at) { return bytes_.rfind('\n', at) + 1; };
        const std::size_t from = line_at(below(bytes_.size()));
        const std::size_t end = std::min(bytes_.find('\n', from), bytes_.size() - 1) + 1;
        if (from < end) {
            const std::string line = bytes_.substr(from, end - from);
            bytes_.erase(from, line.size());
            bytes_.insert(bytes_.empty() ? 0 : line_at(below(bytes_.size())), line);
        }
    }

    void end_as(const std::string& other) {
        bytes_.resize(below(bytes_.size()));
        bytes_ += other.substr(below(other.size() + 1));
    }

private:
    std::string& bytes_;
    RandomGenerator& dice_;
};

} // namespace

std::string mutated(std::span<const std::string> seeds, std::span<const std::string> words, RandomGenerator& dice) {
    std::string bytes;
    Faults faults(bytes, dice);
    bytes = seeds[faults.below(seeds.size())];
    for (std::size_t left = 1 + faults.below(1 + faults.below(4)); left > 0 && !bytes.empty(); --left) {
        switch (faults.below(11)) {
        case 0:
            faults.flip_bit();
            break;
        case 1:
            faults.set_byte();
            break;
        case 2:
            faults.set_binary_number();
            break;
        case 3:
        case 4:
            faults.set_text_number();
            break;
        case 5:
            faults.cut_end();
            break;
        case 6:
            faults.take_out();
            break;
        case 7:
            faults.double_piece();
            break;
        case 8:
            faults.put_word(words);
            break;
        case 9:
            faults.swap_lines();
            break;
        default:
            faults.end_as(seeds[faults.below(seeds.size())]);
        }
    }
    return bytes;
}

} // namespace octant::tests::formats
