#pragma once

#include "ui/base/json_value.h"

#include <string>

namespace octant::ui::base {

/// A figure as it stands in a line of text: numbers that are no whole ones with six digits.
std::string text_of_value(const JsonValue& figure);

/// One figure a line, names in a column; members of lists on lines of their own.
std::string text_of_results(const JsonValue& results);

/// As JSON with a line end; bytes of file names that are no UTF-8 are replaced.
std::string json_of_results(const JsonValue& results);

/// Writes the figures to standard output, as JSON or as text.
void print_value(const JsonValue& results, bool as_json);

} // namespace octant::ui::base
