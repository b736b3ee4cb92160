#pragma once

#include "sim/base/text_scanner.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant {

/// Returns the field separator of a table, found from its line of column names: a tab if the line has one; else a
/// semicolon if the line has one and no comma; else a comma.
char separator_of(std::string_view column_names);

/// Splits a row into fields. Blanks and one pair of double quotes around a field are removed; a separator between
/// quotes does not split. The fields are views of the row.
std::vector<std::string_view> table_fields(std::string_view row, char separator);

/// The first field from `begin` on with this name; upper and lower case are equal.
std::optional<std::size_t> field_named(
    std::span<const std::string_view> fields, std::string_view name, std::size_t begin = 0);

struct TableColumn {
    std::string_view name; ///< empty: no table has it
    bool is_required = false;
};

/// Reads a table of text: rows of fields, of which the first may name the columns. Empty lines and lines that begin
/// with # are skipped. Views are valid until the next row; for a text in memory as long as the text.
class ColumnReader {
public:
    /// `separator` 0: separator_of() the first row.
    explicit ColumnReader(TextScanner lines, char separator = '\0');

    /// Advances to the next row; false at the end.
    bool next_row();

    std::string_view row() const { return lines_.line(); }

    const std::vector<std::string_view>& fields() const { return fields_; }

    /// The last comment before the first row, with its #; empty if there is none.
    const std::string& comment() const { return comment_; }

    /// Takes the current row as the names of the columns and finds `columns` among them; others are ignored. Throws
    /// Error if a required column is missing or one of `columns` occurs twice.
    void find(std::span<const TableColumn> columns);

    /// Throws Error unless the row has a field for each name; more fields must be empty.
    void check_field_count() const;

    /// True if the table has column `i` of find(). Only then are text() and number() allowed.
    bool has(std::size_t i) const { return field_of_[i].has_value(); }

    /// True if the table has column `i` and the row is long enough for it.
    bool reaches(std::size_t i) const { return has(i) && *field_of_[i] < fields_.size(); }

    std::string_view text(std::size_t i) const { return fields_[*field_of_[i]]; }

    /// Throws Error if the field is no finite number.
    double number(std::size_t i) const;

    /// Line of the row, from 1.
    int line_number() const { return lines_.line_number(); }

    /// True if the row is the last line of the file and has no line end.
    bool is_truncated() const { return lines_.is_truncated(); }

    /// Throws Error "file:line: expected ..., got ..." about the row.
    [[noreturn]] void refuse(std::string_view expected, std::string_view got) const { lines_.refuse(expected, got); }

private:
    TextScanner lines_;
    char separator_;
    std::vector<std::string_view> fields_;
    std::string comment_;
    bool has_row_ = false;
    std::size_t name_count_ = 0;
    std::vector<TableColumn> columns_; ///< those of find()
    std::vector<std::optional<std::size_t>> field_of_;
};

} // namespace octant
