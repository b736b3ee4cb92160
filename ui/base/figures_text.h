#pragma once

#include "ui/base/figures.h"

#include <string>

namespace octant::ui::base {

/// A figure as it stands in a line of text: numbers that are no whole ones with six digits.
std::string figure_text(const Figures& figure);

/// One figure a line, names in a column; members of lists on lines of their own.
std::string figures_text(const Figures& figures);

/// As JSON with a line end; bytes of file names that are no UTF-8 are replaced.
std::string figures_json(const Figures& figures);

/// Writes the figures to standard output, as JSON or as text.
void print_figures(const Figures& figures, bool as_json);

} // namespace octant::ui::base
