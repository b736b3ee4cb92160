#include "tests/models/meshfile/mutations.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::meshfile::test {

namespace {

/// A range of bytes.
struct Piece {
    std::size_t first = 0;
    std::size_t count = 0;
};

class Mutation {
public:
    Mutation(std::string bytes, std::uint32_t seed) : bytes_(std::move(bytes)), random_(seed) {}

    std::string made() {
        const std::size_t faults = 1 + below(3);
        for (std::size_t i = 0; i < faults && !bytes_.empty(); ++i) { make_fault(); }
        return std::move(bytes_);
    }

private:
    std::size_t below(std::size_t limit) { return random_() % limit; }

    void make_fault() {
        switch (below(8)) {
        case 0:
            bytes_[below(bytes_.size())] ^= static_cast<char>(1U << below(8));
            break;
        case 1:
            bytes_[below(bytes_.size())] = static_cast<char>(below(256));
            break;
        case 2:
            bytes_.resize(below(bytes_.size()));
            break;
        case 3:
        case 4:
            replace_written_number();
            break;
        case 5:
            replace_binary_number();
            break;
        case 6:
            move_piece(some_line(), some_line());
            break;
        default:
            move_piece(some_bytes(), some_bytes());
            break;
        }
    }

    void replace_written_number() {
        constexpr std::array<std::string_view, 14> numbers{"-1", "0", "nan", "-inf", "1e300", "-1e308", "1e-320",
            "2147483648", "4294967295", "9223372036854775807", "99999999999999999999", "0.5", "3", ""};
        const std::size_t from = below(bytes_.size());
        std::size_t first = from;
        const auto in_number = [&](std::size_t at) {
            return at < bytes_.size() && std::string_view("+-.0123456789").find(bytes_[at]) != std::string_view::npos;
        };
        while (first < bytes_.size() && !in_number(first)) { ++first; }
        std::size_t last = first;
        while (in_number(last)) { ++last; }
        bytes_.replace(first, last - first, numbers[below(numbers.size())]);
    }

    void replace_binary_number() {
        constexpr std::array<std::string_view, 7> numbers{std::string_view("\xff\xff\xff\xff", 4),
            std::string_view("\x00\x00\x00\x80", 4), std::string_view("\xff\xff\xff\x7f", 4),
            std::string_view("\x00\x00\xc0\x7f", 4), std::string_view("\x00\x00\x80\xff", 4),
            std::string_view("\x00\x00\x00\x00", 4), std::string_view("\xff\xff\xff\xff\xff\xff\xff\x7f", 8)};
        const std::string_view number = numbers[below(numbers.size())];
        const std::size_t first = below(bytes_.size());
        bytes_.replace(first, std::min(number.size(), bytes_.size() - first), number);
    }

    Piece some_bytes() {
        const std::size_t first = below(bytes_.size());
        return {first, std::min(1 + below(40), bytes_.size() - first)};
    }

    Piece some_line() {
        const std::size_t at = below(bytes_.size());
        const std::size_t before = at == 0 ? std::string::npos : bytes_.rfind('\n', at - 1);
        const std::size_t first = before == std::string::npos ? 0 : before + 1;
        const std::size_t end = std::min(bytes_.find('\n', at), bytes_.size() - 1);
        return {first, end + 1 - first};
    }

    /// Takes the piece out, doubles it or swaps it with another.
    void move_piece(Piece a, Piece b) {
        if (b.first < a.first) { std::swap(a, b); }
        const std::string text = bytes_.substr(a.first, a.count);
        switch (below(3)) {
        case 0:
            bytes_.erase(a.first, a.count);
            break;
        case 1:
            bytes_.insert(a.first, text);
            break;
        default:
            const std::string other = bytes_.substr(b.first, b.count);
            if (a.first + a.count <= b.first) {
                bytes_.replace(b.first, b.count, text);
                bytes_.replace(a.first, a.count, other);
            }
            break;
        }
    }

    std::string bytes_;
    std::mt19937 random_;
};

} // namespace

std::string mutated(std::string bytes, std::uint32_t seed) { return Mutation(std::move(bytes), seed).made(); }

} // namespace octant::models::meshfile::test
