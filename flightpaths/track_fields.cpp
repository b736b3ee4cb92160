#include "flightpaths/track_fields.h"

#include "sim/base/text_file.h"

#include <algorithm>

namespace octant::flightpaths {

char separator_of(std::string_view column_names) {
    const auto has = [&](char c) { return column_names.find(c) != std::string_view::npos; };
    if (has('\t')) {
        return '\t';
    }
    return has(';') && !has(',') ? ';' : ',';
}

std::vector<std::string_view> unquoted_fields(std::string_view line, char separator) {
    std::vector<std::string_view> fields = split_fields(line, separator);
    for (std::string_view& field : fields) {
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
            field = field.substr(1, field.size() - 2);
        }
    }
    return fields;
}

bool are_empty(std::span<const std::string_view> fields) {
    return std::ranges::all_of(fields, &std::string_view::empty);
}

} // namespace octant::flightpaths
