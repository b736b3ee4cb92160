// Source: Netpbm, pgm(5), "Plain PGM": P2, width, height, largest value, then values from the top
// left, separated by white space; '#' starts a comment that runs to the end of its line.
// Deviations: none.
#include "models/heights/plain_pgm.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <string>
#include <string_view>

namespace octant::models::heights {

namespace {

/// Hands out the words of a text one after another and knows their line.
class Words {
public:
    explicit Words(std::string_view text)
        : text_(text) {}

    int line() const { return line_; }

    /// The next word; empty at the end of the text.
    std::string_view next() {
        while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#')) {
            if (text_[at_] == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else {
                line_ += text_[at_] == '\n' ? 1 : 0;
                ++at_;
            }
        }
        const std::size_t start = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '#') {
            ++at_;
        }
        return text_.substr(start, at_ - start);
    }

private:
    static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
};

long number_between(
    const std::filesystem::path& path, Words& words, long lowest, long highest, const char* what) {
    const std::string_view word = words.next();
    if (word.empty()) {
        throw_error_at(path, words.line(), fmt::format("expected {}, got the end of the file", what));
    }
    const auto number = whole_number(word);
    if (!number || *number < lowest || *number > highest) {
        const std::string got = printable(std::string(word));
        throw_error_at(
            path,
            words.line(),
            fmt::format("expected {} from {} to {}, got '{}'", what, lowest, highest, got));
    }
    return *number;
}

} // namespace

bool is_plain_pgm(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    char first = 0;
    char second = 0;
    char third = 0;
    in.get(first).get(second).get(third);
    return in && first == 'P' && second == '2' &&
           (third == '#' || third == ' ' || (third >= '\t' && third <= '\r'));
}

HeightGrid
read_plain_pgm(const std::filesystem::path& path, const std::function<void(int, int)>& check_size) {
    constexpr std::size_t largest_bytes = std::size_t{4} << 30;
    constexpr long largest_side = 1'000'000'000;
    const std::string text = read_text_file(path, largest_bytes);
    Words words(text);
    words.next();
    HeightGrid grid;
    grid.columns = static_cast<int>(number_between(path, words, 1, largest_side, "a width"));
    grid.rows = static_cast<int>(number_between(path, words, 1, largest_side, "a height"));
    check_size(grid.columns, grid.rows);
    const long largest = number_between(path, words, 1, 65535, "a largest value");
    const std::size_t columns = static_cast<std::size_t>(grid.columns);
    const std::size_t count = columns * static_cast<std::size_t>(grid.rows);
    if (count > text.size()) {
        throw_error_in(
            path, fmt::format("expected {} values, got a file of {} bytes", count, text.size()));
    }
    grid.heights_m.resize(count);
    for (int row = grid.rows - 1; row >= 0; --row) {
        for (int column = 0; column < grid.columns; ++column) {
            grid.heights_m[grid.index(column, row)] =
                static_cast<float>(number_between(path, words, 0, largest, "a grey value"));
        }
    }
    return grid;
}

} // namespace octant::models::heights
