#include "models/meshfile/word_scanner.h"

#include "models/meshfile/mesh_join.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::models::meshfile {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

} // namespace

std::string_view WordScanner::word_or_end() {
    std::size_t at = 0;
    for (; at < text_.size() && is_blank(text_[at]); ++at) { line_ += static_cast<int>(text_[at] == '\n'); }
    std::size_t end = at;
    while (end < text_.size() && !is_blank(text_[end])) { ++end; }
    const std::string_view found = text_.substr(at, end - at);
    text_.remove_prefix(end);
    return found;
}

std::string_view WordScanner::word(std::string_view what) {
    const std::string_view found = word_or_end();
    if (found.empty()) { refuse(what, "the end of the file"); }
    return found;
}

std::string_view WordScanner::rest_of_line() {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view rest = text_.substr(0, end);
    text_.remove_prefix(end);
    while (!rest.empty() && is_blank(rest.back())) { rest.remove_suffix(1); }
    while (!rest.empty() && is_blank(rest.front())) { rest.remove_prefix(1); }
    return rest;
}

void WordScanner::skip_bytes(std::size_t count, std::string_view what) {
    if (count > text_.size()) {
        refuse(fmt::format("{} ({} bytes)", what, count), fmt::format("{} to the end of the file", text_.size()));
    }
    line_ += static_cast<int>(std::ranges::count(text_.substr(0, count), '\n'));
    text_.remove_prefix(count);
}

double WordScanner::number(std::string_view what) {
    const std::string_view found = word(what);
    const auto value = finite_number(found);
    if (!value || std::abs(*value) > max_coordinate) { refuse(what, in_quotes(found)); }
    return *value;
}

long WordScanner::whole(std::string_view what, long min, long max) {
    const std::string_view found = word(what);
    const auto value = whole_number(found);
    if (!value || *value < min || *value > max) {
        refuse(fmt::format("{} of {} to {}", what, min, max), in_quotes(found));
    }
    return *value;
}

void WordScanner::refuse(std::string_view expected, std::string_view got) const {
    throw_error_at(path_, line_, fmt::format("expected {}, got {}", expected, got));
}

std::string in_quotes(std::string_view text) {
    return fmt::format("'{}'", printable(std::string(text.substr(0, 100))));
}

} // namespace octant::models::meshfile
