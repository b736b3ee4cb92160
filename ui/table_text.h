#pragma once

#include "ui/report/html_text.h"

#include <string>

namespace octant::ui {

/// A table as comma-separated text: header, rows; cells with commas in quotes.
std::string csv_of(const report::HtmlTable& table);

/// A table as Markdown: title, table, note.
std::string markdown_of(const report::HtmlTable& table);

} // namespace octant::ui
