#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// True for 0 to 9.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// What separates the fields of a track: tabs where its line of column names has one, else semicolons where it has no
/// comma but one of them, else commas.
char separator_of(std::string_view column_names);

/// The fields of a line without blanks and one pair of quotes around them, within which a separator separates nothing.
/// They are views of the line.
std::vector<std::string_view> unquoted_fields(std::string_view line, char separator);

/// True when no field holds anything, as behind a separator that ends a line.
bool are_empty(std::span<const std::string_view> fields);

} // namespace octant::flightpaths
