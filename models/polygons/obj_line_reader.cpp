#include "models/polygons/obj_line_reader.h"

#include "models/polygons/obj_limits.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::models::polygons {

namespace {

bool is_comment(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    return first != std::string_view::npos && line[first] == '#';
}

/// Takes the backslash off the end; false when there is none.
bool goes_on(std::string_view& line) {
    if (!line.ends_with('\\')) { return false; }
    line.remove_suffix(1);
    return true;
}

} // namespace

std::string_view without_byte_order_mark(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) { text.remove_prefix(3); }
    return text;
}

ObjLineReader::ObjLineReader(std::string_view text) : rest_(without_byte_order_mark(text)) {}

/// Takes the next line off the rest, which must not be empty.
std::string_view ObjLineReader::next_line() {
    ++lines_;
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    if (line.ends_with('\r')) { line.remove_suffix(1); }
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    return line;
}

bool ObjLineReader::next() {
    if (rest_.empty()) { return false; }
    text_ = next_line();
    number_ = lines_;
    if (is_comment(text_) || !goes_on(text_)) { return true; }
    joined_ = text_;
    bool more = true;
    while (more && !rest_.empty()) {
        std::string_view part = next_line();
        more = goes_on(part);
        joined_ += ' ';
        joined_ += part;
    }
    text_ = joined_;
    return true;
}

std::string_view after_first_word(std::string_view line) {
    constexpr std::string_view blanks = " \t\r";
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    line.remove_prefix(std::min(line.find_first_of(blanks), line.size()));
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    return line.substr(0, line.find_last_not_of(blanks) + 1);
}

double obj_number(std::string_view word, const std::filesystem::path& path, int line) {
    const auto value = finite_number(word);
    if (!value) {
        throw_error_at(path, line, fmt::format("expected a number, got '{}'", printable(std::string(word))));
    }
    if (std::abs(*value) > max_obj_coordinate_m) {
        throw_error_at(path, line,
            fmt::format("expected a number within {:g}, got '{}'", max_obj_coordinate_m, printable(std::string(word))));
    }
    return *value;
}

} // namespace octant::models::polygons
