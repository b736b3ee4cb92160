#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace octant::ui::base {

/// One figure a line, names in a column, six digits; members of lists of text on lines of their
/// own.
std::string figures_text(const nlohmann::ordered_json& figures);

/// As JSON with a line end; bytes of file names that are no UTF-8 are replaced.
std::string figures_json(const nlohmann::ordered_json& figures);

/// Either to standard output.
void print_figures(const nlohmann::ordered_json& figures, bool as_json);

} // namespace octant::ui::base
