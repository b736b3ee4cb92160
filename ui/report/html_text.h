#pragma once

#include "ui/base/study_output.h"

#include <fmt/format.h>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::report {

/// Cells of a table from one format string with a tab between cells: cells("{}\t{:.2f}", name, time_ms). A tab within a
/// value does not separate cells.
template <class... Values>
std::vector<std::string> cells(fmt::format_string<const Values&...> format, const Values&... values);

/// A table of results for pages, CSV, Markdown and JSON.
struct HtmlTable {
    std::string title;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows; ///< a shorter row is filled with empty cells
    std::string note;                           ///< below the table; empty = none

    /// Appends a row, with the arguments of cells().
    template <class... Values>
    void add_row(fmt::format_string<const Values&...> format, const Values&... values) {
        rows.push_back(cells<Values...>(format, values...));
    }
};

/// The text of cells(): separated by 0x1F in place of tabs.
std::vector<std::string> formatted_cells(fmt::string_view format, fmt::format_args values);

template <class... Values>
std::vector<std::string> cells(fmt::format_string<const Values&...> format, const Values&... values) {
    return formatted_cells(fmt::string_view(format), fmt::make_format_args(values...));
}

/// Appends cells to a row, with the arguments of cells().
template <class... Values>
void append_cells(std::vector<std::string>& row, fmt::format_string<const Values&...> format, const Values&... values) {
    for (std::string& cell : cells<Values...>(format, values...)) { row.push_back(std::move(cell)); }
}

/// Text as HTML shows it, fit for attributes too: & < > " ' replaced, control characters but line ends and tabs
/// dropped, bytes that are no UTF-8 replaced by U+FFFD.
std::string escaped(std::string_view text);

/// A relative way to a file as a link has it: what is no letter, digit or one of -._~/ as %20.
std::string url_text(std::string_view path);

/// Title, table and note as HTML, all text escaped. Cells that are numbers are aligned right.
std::string html_of(const HtmlTable& table);

/// A table as comma-separated text: header, rows; cells with commas in quotes.
std::string csv_of(const HtmlTable& table);

/// A table as Markdown: title, table, note.
std::string markdown_of(const HtmlTable& table);

/// Tables as Markdown, separated by blank lines.
std::string markdown_of(std::span<const HtmlTable> tables);

/// Tables as JSON: a list of objects with "title", "rows" (an object a row, by column) and "note".
std::string json_of(std::span<const HtmlTable> tables);

/// The tables that a study writes: a CSV file for each, and one Markdown page.
class StudyTables {
public:
    /// Makes the folder of the output. Throws Error.
    explicit StudyTables(base::StudyOutput output);

    /// Writes the table as FILE.csv into the folder; `file` has no ending. Throws Error.
    void add(const std::string& file, HtmlTable table);

    const std::vector<HtmlTable>& tables() const { return tables_; }

    std::string markdown() const { return markdown_of(tables_); }

    /// Writes `markdown` and then `figures` as PAGE.md, and prints the tables as JSON, or else `markdown`. Throws
    /// Error.
    void finish(const std::string& page, const std::string& markdown, const std::string& figures = "") const;

private:
    base::StudyOutput output_;
    std::vector<HtmlTable> tables_;
};

/// Style sheet of all pages: light or dark as the reader's system, printable.
std::string_view page_style();

/// The beginning of every page, up to its opened main element; `layout`: "one" or "several" as the style sheet has
/// them.
std::string page_head(std::string_view title, std::string_view layout);

} // namespace octant::ui::report
