#pragma once

#include "ui/report/html_text.h"

#include <span>
#include <string>

namespace octant::ui::report {

/// A table as comma-separated text: header, rows; cells with commas in quotes.
std::string csv_of(const report::HtmlTable& table);

/// A table as Markdown: title, table, note.
std::string markdown_of(const report::HtmlTable& table);

/// Tables as JSON: a list of objects with "title", "rows" (an object a row, by column) and "note".
std::string json_of(std::span<const report::HtmlTable> tables);

} // namespace octant::ui::report
