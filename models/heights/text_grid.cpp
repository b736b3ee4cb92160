#include "models/heights/text_grid.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/import_options.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <memory>
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
        return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
    });
}

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& words) {
    return std::ranges::any_of(words, [&](std::string_view w) { return is_same_word(word, w); });
}

/// Reads a file through GDAL. Lines of a text grid may be longer than memory, so it is read word by word.
TextScanner words_of(const path& file, const TextRules& rules) {
    const std::shared_ptr<VSILFILE> stream(VSIFOpenL(file.c_str(), "rb"), [](VSILFILE* opened) {
        if (opened != nullptr) { VSIFCloseL(opened); }
    });
    if (!stream) { throw_error_in(file, "cannot be opened for reading"); }
    return {file, [stream](char* to, std::size_t size) { return VSIFReadL(to, 1, size, stream.get()); }, rules};
}

std::size_t digits_at(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9') { ++end; }
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
    if (whole + parts == 0) { return false; }
    if (at < word.size() && (word[at] == 'e' || word[at] == 'E')) {
        const bool has_sign = at + 1 < word.size() && (word[at + 1] == '-' || word[at + 1] == '+');
        at += has_sign ? 2U : 1U;
        const std::size_t power = digits_at(word, at);
        if (power == 0) { return false; }
        at += power;
    }
    return at == word.size();
}

/// Whether GDAL reads a word as a number that is not finite, which is without data.
bool is_not_finite(std::string_view word) {
    constexpr std::array<std::string_view, 12> words = {"nan", "-nan", "+nan", "inf", "-inf", "+inf", "infinity",
        "1.#QNAN", "-1.#QNAN", "-1.#IND", "1.#INF", "-1.#INF"};
    return is_one_of(word, words);
}

/// Whether a word says that there is no data.
bool is_void_word(std::string_view word) {
    constexpr std::array<std::string_view, 9> words = {
        "NA", "N/A", "#N/A", "ND", "NULL", "NODATA", "NO_DATA", "VOID", "-"};
    return is_one_of(word, words) || word.find_first_not_of('*') == std::string_view::npos;
}

bool is_key(std::string_view word) {
    constexpr std::array<std::string_view, 21> keys = {"ncols", "nrows", "xllcorner", "yllcorner", "xllcenter",
        "yllcenter", "cellsize", "dx", "dy", "nodata_value", "nodata", "byteorder",
        "north:", "south:", "east:", "west:", "rows:", "cols:", "null:", "type:", "multiplier:"};
    return is_one_of(word, keys);
}

bool is_alphabetic(std::string_view word) { return std::isalpha(static_cast<unsigned char>(word.front())) != 0; }

/// Whether a file may be an ESRI or GRASS text grid.
bool begins_with_key(const path& file) {
    VSILFILE* const stream = VSIFOpenL(file.c_str(), "rb");
    if (stream == nullptr) {
        return false; // a folder, or a name that only a driver knows
    }
    std::array<char, 16> bytes = {};
    const std::size_t size = VSIFReadL(bytes.data(), 1, bytes.size(), stream);
    VSIFCloseL(stream);
    const std::string_view text(bytes.data(), size);
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
    return !word.empty() && is_key(word);
}

/// A file of GDAL's in memory that reads as another file, in which `zeros` bytes from `begin` on are the digit 0. It
/// exists while this object lives.
class FileWithZeros {
public:
    FileWithZeros(const std::string& name, const path& file, std::uint64_t begin, std::size_t zeros) : name_(name) {
        VSIStatBufL status;
        if (VSIStatL(file.c_str(), &status) != 0) { return; }
        const auto bytes = static_cast<std::uint64_t>(status.st_size);
        char* const escaped = CPLEscapeString(file.c_str(), -1, CPLES_XML);
        const auto part = [escaped](std::uint64_t from, std::uint64_t to) {
            return fmt::format("<SubfileRegion><Filename relative=\"0\">{0}</Filename><DestinationOffset>{1}"
                               "</DestinationOffset><SourceOffset>{1}</SourceOffset><RegionLength>{2}"
                               "</RegionLength></SubfileRegion>",
                escaped, from, to - from);
        };
        const std::string zero_part =
            fmt::format("<ConstantRegion><DestinationOffset>{}</DestinationOffset><RegionLength>{}"
                        "</RegionLength><Value>{}</Value></ConstantRegion>",
                begin, zeros, int{'0'});
        text_ = fmt::format("<VSISparseFile><Length>{}</Length>{}{}</VSISparseFile>", bytes,
            zeros == 0 ? "" : part(0, begin) + zero_part, part(begin + zeros, bytes));
        CPLFree(escaped);
        VSIFCloseL(VSIFileFromMemBuffer(name.c_str(), reinterpret_cast<GByte*>(text_.data()), text_.size(), FALSE));
    }

    ~FileWithZeros() { VSIUnlink(name_.c_str()); }

    FileWithZeros(const FileWithZeros&) = delete;
    FileWithZeros& operator=(const FileWithZeros&) = delete;
    FileWithZeros(FileWithZeros&&) = delete;
    FileWithZeros& operator=(FileWithZeros&&) = delete;

private:
    std::string name_;
    std::string text_;
};

class GridCheck {
public:
    GridCheck(const path& file, const std::string& driver, int columns, int rows)
        : words_(words_of(file, {.separators = driver == points ? ",;" : ""})), driver_(driver),
          samples_(std::int64_t{columns} * rows) {}

    TextVoids run() {
        if (driver_ == points) {
            check_points();
            return {};
        }
        check_samples(driver_ == surfer ? surfer_header() : keyed_header());
        return voids_;
    }

private:
    /// The next word, valid until the next call; empty at the end. Throws Error for a word that is too long for a
    /// number.
    std::string_view next() {
        constexpr std::size_t max_letters = 1000;
        const std::string_view word = words_.word_or_end();
        if (word.size() > max_letters) {
            words_.refuse("a number", fmt::format("a word of more than {} letters", max_letters));
        }
        return word;
    }

    /// Lines of a key and its value. Returns the first word behind them.
    std::string_view keyed_header() {
        while (true) {
            const std::string_view word = next();
            if (word.empty() || !is_key(word)) { return word; }
            const std::string key(word);
            const std::string_view value = next();
            if (value.empty()) { words_.refuse_next(fmt::format("a value of {}", printable(key))); }
            check_value(key, value);
        }
    }

    void check_value(std::string_view key, std::string_view value) {
        constexpr std::array<std::string_view, 9> numbers = {
            "ncols", "nrows", "xllcorner", "yllcorner", "xllcenter", "yllcenter", "cellsize", "dx", "dy"};
        if (is_one_of(key, numbers) && !is_number(value)) { words_.refuse_last(fmt::format("a number for {}", key)); }
        const bool is_mark = is_same_word(key, "nodata_value") || is_same_word(key, "null:");
        voids_.declares_no_number =
            voids_.declares_no_number || (is_mark && !is_number(value) && !is_not_finite(value));
    }

    std::string_view surfer_header() {
        constexpr int header_numbers = 8;
        next(); // DSAA
        for (int i = 0; i < header_numbers; ++i) { check_number(next()); }
        return next();
    }

    void check_number(std::string_view word) {
        if (word.empty()) { words_.refuse_next("a number"); }
        if (!is_number(word) && !is_not_finite(word)) { words_.refuse_last("a number"); }
    }

    void check_samples(std::string_view word) {
        std::int64_t seen = 0;
        for (; !word.empty() && seen < samples_; word = next()) {
            if (!is_number(word)) {
                if (driver_ == surfer || !(is_void_word(word) || is_not_finite(word))) {
                    words_.refuse_last("a height");
                }
                add_void(seen, word); // GDAL makes 0 of NaN in a grid of whole numbers
            }
            ++seen;
        }
        if (seen < samples_) {
            words_.refuse(fmt::format("{} heights", samples_), fmt::format("the end of the file after {}", seen));
        }
        for (; !word.empty(); word = next()) { ++voids_.numbers_left; }
    }

    void add_void(std::int64_t sample, std::string_view word) {
        if (voids_.samples++ == 0) { voids_.word = printable(std::string(word)); }
        voids_.are_void.resize(static_cast<std::size_t>(sample) + 1);
        voids_.are_void.back() = true;
    }

    /// Numbers only, but for a first line without any, which names columns.
    void check_points() {
        std::string name; // a word of the first line that is no number
        bool has_number = false;
        for (std::string_view word = next(); !word.empty(); word = next()) {
            if (words_.line_number() > 1) {
                check_number(word);
                continue;
            }
            const bool is_name = !is_number(word) && !is_not_finite(word);
            has_number = has_number || !is_name;
            name = is_name && name.empty() ? std::string(word) : name;
            if (has_number && !name.empty()) { words_.refuse("a number", in_quotes(name)); }
        }
    }

    TextScanner words_;
    std::string_view driver_;
    std::int64_t samples_;
    TextVoids voids_;
};

} // namespace

void TextVoids::apply(std::int64_t first, std::span<double> raw) const {
    const auto begin = static_cast<std::size_t>(first);
    for (std::size_t i = 0; i < raw.size() && begin + i < are_void.size(); ++i) {
        raw[i] = are_void[begin + i] ? std::numeric_limits<double>::quiet_NaN() : raw[i];
    }
}

Dataset open_grid_that_begins_with_word(const path& file) {
    if (!begins_with_key(file)) { return nullptr; }
    TextScanner words = words_of(file, {});
    while (is_key(words.peek())) {
        words.word_or_end();
        words.word_or_end(); // its value
    }
    const std::string_view word = words.peek();
    if (word.empty() || !is_alphabetic(word)) { return nullptr; }
    if (!is_void_word(word) && !is_not_finite(word)) { words.refuse_next("a height"); }
    // GDAL looks for side files in the folder of the grid, which is in memory here.
    const std::string folder = fmt::format("/vsimem/octant-{}", static_cast<const void*>(&words));
    const path name = path(folder) / file.filename();
    const FileWithZeros grid(name.string(), file, words.offset(), word.size());
    const FileWithZeros system(
        path(name).replace_extension(".prj").string(), path(file).replace_extension(".prj"), 0, 0);
    const FileWithZeros side(name.string() + ".aux.xml", file.string() + ".aux.xml", 0, 0);
    constexpr unsigned flags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
    const std::string sparse = "/vsisparse/" + name.string();
    Dataset dataset(GDALOpenEx(sparse.c_str(), flags, nullptr, nullptr, nullptr));
    if (!dataset) { throw_unreadable(file, "a height field", "a header without size, place or cells"); }
    return dataset;
}

Dataset open_plain_pgm(const path& file) {
    std::ifstream in(file, std::ios::binary);
    std::array<char, 3> begin{};
    in.read(begin.data(), begin.size());
    if (!in || begin[0] != 'P' || begin[1] != '2' ||
        std::string_view("# \t\n\v\f\r").find(begin[2]) == std::string::npos) {
        return nullptr;
    }
    constexpr std::size_t largest_bytes = std::size_t{4} << 30;
    constexpr long largest_side = 1'000'000'000;
    const std::string text = read_text_file(file, largest_bytes);
    TextScanner words(file, text, {.comment = '#'});
    words.word_or_end();
    const auto number = [&words](const char* what, long min, long max) {
        const auto value = words.take_integer(min, max);
        if (!value) {
            words.refuse_next(words.peek().empty() ? what : fmt::format("{} from {} to {}", what, min, max));
        }
        return *value;
    };
    const auto columns = static_cast<int>(number("a width", 1, largest_side));
    const auto rows = static_cast<int>(number("a height", 1, largest_side));
    check_size(file, columns, rows, max_import_samples);
    const long largest = number("a largest value", 1, 65535);
    const std::size_t count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    if (count > text.size()) {
        throw_error_in(file, fmt::format("expected {} values, got a file of {} bytes", count, text.size()));
    }
    Dataset dataset(GDALCreate(GDALGetDriverByName("MEM"), "", columns, rows, 1, GDT_UInt16, nullptr));
    if (!dataset) { throw_error_in(file, "expected a height field that fits in memory, got a larger one"); }
    std::vector<std::uint16_t> line(static_cast<std::size_t>(columns));
    for (int row = 0; row < rows; ++row) {
        for (std::uint16_t& grey : line) { grey = static_cast<std::uint16_t>(number("a grey value", 0, largest)); }
        if (GDALRasterIO(GDALGetRasterBand(dataset.get(), 1), GF_Write, 0, row, columns, 1, line.data(), columns, 1,
                GDT_UInt16, 0, 0) != CE_None) {
            throw_error_in(file, "expected a height field that fits in memory, got a larger one");
        }
    }
    return dataset;
}

bool is_text_grid(const std::string& driver) {
    return driver == esri || driver == grass || driver == surfer || driver == points;
}

TextVoids check_text_grid(const path& file, const std::string& driver, int columns, int rows) {
    return GridCheck(file, driver, columns, rows).run();
}

} // namespace octant::models::heights
