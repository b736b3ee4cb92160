#include "flightpaths/track_fields.h"

#include "sim/base/text_file.h"

#include <algorithm>

namespace octant::flightpaths {

char separator_of(std::string_view column_names) {
    const auto has = [&](char c) { return column_names.find(c) != std::string_view::npos; };
    if (has('\t')) { return '\t'; }
    return has(';') && !has(',') ? ';' : ',';
}

std::vector<std::string_view> unquoted_fields(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    while (true) {
        const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
        std::size_t end = line.find(separator);
        if (begin < line.size() && line[begin] == '"') {
            const std::size_t quote = line.find('"', begin + 1);
            end = quote == std::string_view::npos ? end : line.find(separator, quote + 1);
        }
        std::string_view field = split_fields(line.substr(0, end), '\0').front();
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
            field = field.substr(1, field.size() - 2);
        }
        fields.push_back(field);
        if (end == std::string_view::npos) { return fields; }
        line.remove_prefix(end + 1);
    }
}

bool are_empty(std::span<const std::string_view> fields) {
    return std::ranges::all_of(fields, &std::string_view::empty);
}

} // namespace octant::flightpaths
