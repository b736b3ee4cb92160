#pragma once

#include <string>
#include <string_view>

namespace octant::ui::report {

/// Text as HTML shows it, fit for attributes too: & < > " ' replaced, control characters but line ends and tabs
/// dropped, bytes that are no UTF-8 replaced by U+FFFD.
std::string escaped(std::string_view text);

/// A JSON string for a script element, which it cannot end: < and & as \u003c, bytes that are no UTF-8 replaced by
/// U+FFFD.
std::string script_string(std::string_view text);

/// A relative path for a link: all characters but letters, digits and -._~/ as %20.
std::string url_text(std::string_view path);

/// Parts of a page. `text` is escaped, `html` is not: a heading of the second rank, a paragraph in small soft letters,
/// a frame around other parts.
std::string heading_html(std::string_view text);
std::string note_html(std::string_view text);
std::string card_html(std::string_view html);

/// The beginning of every page, with style sheet (light or dark as the reader's system, printable), title and the line
/// above it. Wide pages are for tables of many columns.
std::string page_head(std::string_view title, std::string_view lead, bool is_wide = false);

/// The end of every page, with the script that draws its plots, sorts and filters its tables, and makes long tables and
/// lists of plots while the reader scrolls.
std::string page_end();

} // namespace octant::ui::report
