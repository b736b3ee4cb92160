#include "models/heights/text_grid.h"

#include "models/heights/gdal_functions.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

constexpr std::string_view esri = "AAIGrid";
constexpr std::string_view grass = "GRASSASCIIGrid";
constexpr std::string_view surfer = "GSAG";
constexpr std::string_view points = "XYZ";

bool is_same_word(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) ==
               std::tolower(static_cast<unsigned char>(y));
    });
}

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& words) {
    return std::ranges::any_of(words, [&](std::string_view w) { return is_same_word(word, w); });
}

/// Words of a text with the lines on which they stand, read piece by piece.
class WordFile {
public:
    /// `separators` beside white space.
    WordFile(const path& file, std::string_view separators)
        : file_(file)
        , separators_(separators)
        , stream_(VSIFOpenL(file.c_str(), "rb")) {
        if (stream_ == nullptr) {
            error_in(file, "cannot be opened for reading");
        }
    }

    ~WordFile() { VSIFCloseL(stream_); }

    WordFile(const WordFile&) = delete;
    WordFile& operator=(const WordFile&) = delete;
    WordFile(WordFile&&) = delete;
    WordFile& operator=(WordFile&&) = delete;

    /// The next word, valid until the next call; nothing at the end.
    std::optional<std::string_view> next() {
        word_.clear();
        line_of_word_ = line_;
        while (const std::optional<char> c = next_char()) {
            const bool ends_line = *c == '\n' || (*c == '\r' && peek() != '\n');
            const bool parts = ends_line || *c == ' ' || *c == '\t' || *c == '\r' ||
                               separators_.find(*c) != std::string_view::npos;
            if (!parts) {
                word_ += *c;
                continue;
            }
            line_of_word_ = line_;
            line_ += ends_line ? 1 : 0;
            if (!word_.empty()) {
                return word_;
            }
        }
        line_of_word_ = line_;
        return word_.empty() ? std::nullopt : std::optional<std::string_view>(word_);
    }

    /// Of the last word; of the file's last one at the end.
    int line() const { return line_of_word_; }

    [[noreturn]] void refuse(std::string_view expected, const std::string& got) const {
        error_at(file_, line_of_word_, fmt::format("expected {}, got {}", expected, got));
    }

    [[noreturn]] void refuse_word(std::string_view expected, std::string_view word) const {
        refuse(expected, fmt::format("'{}'", printable(std::string(word))));
    }

private:
    bool fill() {
        if (at_ == filled_) {
            filled_ = VSIFReadL(piece_.data(), 1, piece_.size(), stream_);
            at_ = 0;
        }
        return at_ < filled_;
    }

    std::optional<char> next_char() {
        return fill() ? std::optional(piece_.at(at_++)) : std::nullopt;
    }

    char peek() { return fill() ? piece_.at(at_) : '\0'; }

    const path& file_;
    std::string_view separators_;
    VSILFILE* stream_;
    std::array<char, 1 << 16> piece_{};
    std::size_t at_ = 0;
    std::size_t filled_ = 0;
    std::string word_;
    int line_ = 1;
    int line_of_word_ = 1;
};

std::size_t digits_at(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9') {
        ++end;
    }
    return end - at;
}

/// Whether GDAL reads all of a word as a number; a decimal comma counts.
bool is_number(std::string_view word) {
    std::size_t at = word.starts_with('-') || word.starts_with('+') ? 1 : 0;
    const std::size_t whole = digits_at(word, at);
    at += whole;
    std::size_t parts = 0;
    if (at < word.size() && (word[at] == '.' || word[at] == ',')) {
        parts = digits_at(word, at + 1);
        at += 1 + parts;
    }
    if (whole + parts == 0) {
        return false;
    }
    if (at < word.size() && (word[at] == 'e' || word[at] == 'E')) {
        const bool has_sign = at + 1 < word.size() && (word[at + 1] == '-' || word[at + 1] == '+');
        at += has_sign ? 2U : 1U;
        const std::size_t power = digits_at(word, at);
        if (power == 0) {
            return false;
        }
        at += power;
    }
    return at == word.size();
}

/// Whether GDAL reads a word as a number that is not finite, which is without data.
bool is_not_finite(std::string_view word) {
    constexpr std::array<std::string_view, 12> words = {
        "nan",
        "-nan",
        "+nan",
        "inf",
        "-inf",
        "+inf",
        "infinity",
        "1.#QNAN",
        "-1.#QNAN",
        "-1.#IND",
        "1.#INF",
        "-1.#INF"};
    return is_one_of(word, words);
}

/// Whether a word says that there is no data.
bool is_void_word(std::string_view word) {
    constexpr std::array<std::string_view, 9> words = {
        "NA", "N/A", "#N/A", "ND", "NULL", "NODATA", "NO_DATA", "VOID", "-"};
    return is_one_of(word, words) || word.find_first_not_of('*') == std::string_view::npos;
}

class GridCheck {
public:
    GridCheck(const path& file, const std::string& driver, int columns, int rows)
        : words_(file, driver == points ? ",;" : "")
        , driver_(driver)
        , samples_(std::int64_t{columns} * rows) {}

    TextVoids run() {
        if (driver_ == points) {
            check_points();
            return {};
        }
        const std::optional<std::string_view> first =
            driver_ == surfer ? surfer_header() : keyed_header();
        check_samples(first);
        return voids_;
    }

private:
    static bool is_key(std::string_view word) {
        constexpr std::array<std::string_view, 20> keys = {
            "ncols", "nrows", "xllcorner",    "yllcorner", "xllcenter", "yllcenter", "cellsize",
            "dx",    "dy",    "nodata_value", "nodata",    "byteorder", "north:",    "south:",
            "east:", "west:", "rows:",        "cols:",     "null:",     "type:"};
        return is_one_of(word, keys) || is_same_word(word, "multiplier:");
    }

    /// Lines of a key and its value. Returns the first word behind them.
    std::optional<std::string_view> keyed_header() {
        while (const auto word = words_.next()) {
            if (!is_key(*word)) {
                return word;
            }
            const std::string key(*word);
            const auto value = words_.next();
            if (!value) {
                words_.refuse(fmt::format("a value of {}", printable(key)), "the end of the file");
            }
            check_value(key, *value);
        }
        return std::nullopt;
    }

    void check_value(std::string_view key, std::string_view value) {
        constexpr std::array<std::string_view, 9> numbers = {
            "ncols",
            "nrows",
            "xllcorner",
            "yllcorner",
            "xllcenter",
            "yllcenter",
            "cellsize",
            "dx",
            "dy"};
        if (is_one_of(key, numbers) && !is_number(value)) {
            words_.refuse_word(fmt::format("a number for {}", key), value);
        }
        const bool is_mark = is_same_word(key, "nodata_value") || is_same_word(key, "null:");
        voids_.declares_no_number =
            voids_.declares_no_number || (is_mark && !is_number(value) && !is_not_finite(value));
    }

    std::optional<std::string_view> surfer_header() {
        constexpr int header_numbers = 8;
        words_.next(); // DSAA
        for (int i = 0; i < header_numbers; ++i) {
            check_number(words_.next());
        }
        return words_.next();
    }

    void check_number(const std::optional<std::string_view>& word) const {
        if (!word) {
            words_.refuse("a number", "the end of the file");
        }
        if (!is_number(*word) && !is_not_finite(*word)) {
            words_.refuse_word("a number", *word);
        }
    }

    void check_samples(std::optional<std::string_view> word) {
        std::int64_t seen = 0;
        for (; word && seen < samples_; word = words_.next()) {
            if (!is_number(*word)) {
                if (seen == 0 && std::isalpha(static_cast<unsigned char>(word->front())) != 0) {
                    // GDAL takes it for a part of the header.
                    words_.refuse_word("a number for the first height", *word);
                }
                if (driver_ == surfer || !(is_void_word(*word) || is_not_finite(*word))) {
                    words_.refuse_word("a height", *word);
                }
                add_void(seen, *word); // GDAL makes 0 of NaN in a grid of whole numbers
            }
            ++seen;
        }
        if (seen < samples_) {
            words_.refuse(
                fmt::format("{} heights", samples_),
                fmt::format("the end of the file after {}", seen));
        }
        for (; word; word = words_.next()) {
            ++voids_.numbers_left;
        }
    }

    void add_void(std::int64_t sample, std::string_view word) {
        if (voids_.samples++ == 0) {
            voids_.word = printable(std::string(word));
        }
        std::vector<TextVoids::Run>& runs = voids_.runs;
        if (!runs.empty() && runs.back().first + runs.back().samples == sample) {
            ++runs.back().samples;
        } else {
            runs.push_back({sample, 1});
        }
    }

    /// Three numbers a line; the first line may name columns.
    void check_points() {
        while (const auto word = words_.next()) {
            if (words_.line() > 1) {
                check_number(word);
            }
        }
    }

    WordFile words_;
    std::string_view driver_;
    std::int64_t samples_;
    TextVoids voids_;
};

} // namespace

void TextVoids::apply(std::int64_t first, std::span<double> raw) const {
    const std::int64_t end = first + static_cast<std::int64_t>(raw.size());
    auto run =
        std::ranges::upper_bound(runs, first, {}, [](const Run& r) { return r.first + r.samples; });
    for (; run != runs.end() && run->first < end; ++run) {
        const std::int64_t from = std::max(run->first, first);
        const std::int64_t to = std::min(run->first + run->samples, end);
        std::fill(
            raw.begin() + (from - first),
            raw.begin() + (to - first),
            std::numeric_limits<double>::quiet_NaN());
    }
}

bool is_text_grid(const std::string& driver) {
    return driver == esri || driver == grass || driver == surfer || driver == points;
}

TextVoids check_text_grid(const path& file, const std::string& driver, int columns, int rows) {
    return GridCheck(file, driver, columns, rows).run();
}

} // namespace octant::models::heights
