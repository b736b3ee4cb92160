#include "flightpaths/gpx_points.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>

namespace octant::flightpaths {

namespace {

constexpr std::string_view point_start = "<trkpt";
constexpr std::string_view point_end = "</trkpt>";
constexpr std::string_view comment_start = "<!--";
constexpr std::string_view comment_end = "-->";

/// Fields of a row hold no comma and no quote.
std::string_view as_field(std::string_view text) {
    const auto words = split_words(text);
    const bool is_plain = words.size() == 1 && words.front().find_first_of(",\"") == text.npos;
    return is_plain ? words.front() : std::string_view();
}

/// The value of an attribute in a tag; empty where it has none.
std::string_view attribute(std::string_view tag, std::string_view name) {
    for (std::size_t at = tag.find(name); at != tag.npos; at = tag.find(name, at + 1)) {
        const std::size_t quote = tag.find_first_not_of(" \t\r\n=", at + name.size());
        const bool is_whole = at > 0 && split_words(tag.substr(at - 1, 1)).empty();
        const bool is_value = quote != tag.npos && (tag[quote] == '"' || tag[quote] == '\'');
        if (is_whole && is_value) {
            const std::size_t end = tag.find(tag[quote], quote + 1);
            return end == tag.npos ? std::string_view()
                                   : as_field(tag.substr(quote + 1, end - quote - 1));
        }
    }
    return {};
}

/// The text of the first element of this name; empty where there is none.
std::string_view element(std::string_view within, std::string_view name) {
    const std::string opening = fmt::format("<{}>", name);
    const std::size_t at = within.find(opening);
    if (at == within.npos) {
        return {};
    }
    const std::string_view behind = within.substr(at + opening.size());
    return as_field(behind.substr(0, behind.find('<')));
}

} // namespace

bool is_gpx(std::string_view text) {
    constexpr std::size_t head = 4096;
    const std::string_view start = text.substr(0, head);
    const std::size_t first = start.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    return first != start.npos && start[first] == '<' && start.find("<gpx") != start.npos;
}

LogTable gpx_points(const std::filesystem::path& file, std::string_view text) {
    LogTable table;
    table.rows.emplace_back(log_table_columns);
    table.line_numbers.push_back(1);
    int line = 1;
    std::size_t counted = 0;
    const auto line_at = [&](std::size_t at) {
        line += static_cast<int>(std::count(text.begin() + counted, text.begin() + at, '\n'));
        counted = at;
        return line;
    };
    const auto end_of = [&](std::size_t at, std::string_view end) {
        const std::size_t found = text.find(end, at);
        if (found == text.npos) {
            throw_error_at(file, line_at(at), fmt::format("expected {} further on, found none", end));
        }
        return found;
    };
    for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at + 1)) {
        const std::string_view rest = text.substr(at);
        if (rest.starts_with(comment_start)) {
            at = end_of(at, comment_end);
        } else if (rest.starts_with(point_start)) {
            const std::size_t tag_end = end_of(at, ">");
            const std::string_view tag = text.substr(at, tag_end - at);
            const bool is_bare = tag.ends_with('/');
            const std::size_t end = is_bare ? tag_end : end_of(at, point_end);
            const std::string_view within = text.substr(tag_end, end - tag_end);
            table.rows.push_back(fmt::format(
                "{},{},{},{}",
                element(within, "time"),
                attribute(tag, "lat"),
                attribute(tag, "lon"),
                element(within, "ele")));
            table.line_numbers.push_back(line_at(at));
            at = end;
        }
    }
    if (table.rows.size() == 1) {
        throw_error_in(
            file, "expected track points (trkpt), got none: waypoints and routes have no times");
    }
    return table;
}

} // namespace octant::flightpaths
