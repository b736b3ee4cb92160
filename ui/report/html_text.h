#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// A table for a page: every text in it is escaped when it is written.
struct HtmlTable {
    std::string title;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows; ///< a shorter row is filled with empty cells
    std::string note;                           ///< below the table; empty = none
};

/// Text as HTML shows it, fit for attributes too: & < > " ' replaced, control characters but line ends and tabs
/// dropped, bytes that are no UTF-8 replaced by U+FFFD.
std::string escaped(std::string_view text);

/// A relative way to a file as a link has it: what is no letter, digit or one of -._~/ as %20.
std::string url_text(std::string_view path);

std::string base64(std::string_view bytes);

/// Title, table and note. Cells that are numbers are set right.
std::string html_of(const HtmlTable& table);

} // namespace octant::ui::report
