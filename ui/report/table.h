#pragma once

#include "ui/base/json_value.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace octant::ui::report {

/// One cell of a table, with the name of its column: a row of cells describes its table. Examples: Cell("mesh",
/// run.name), Cell("RMS, px", "{:.3f}", run.rms_px).
struct Cell {
    std::string column; ///< for people, with its unit
    std::string text;
    std::string css_class = {}; ///< of the cell in a page
    std::string link = {};      ///< in a page the text leads there; empty = nowhere

    template <class Value>
    Cell(std::string name, const Value& value) : column(std::move(name)), text(fmt::format("{}", value)) {}

    template <class First, class... More>
    Cell(std::string name, fmt::format_string<const First&, const More&...> format, const First& first,
        const More&... more)
        : column(std::move(name)), text(fmt::format(format, first, more...)) {}
};

/// A table of results for pages, CSV, Markdown, LaTeX, JSON and the terminal.
struct ResultTable {
    std::string title = {};
    std::vector<std::string> header = {}; ///< names of the columns; the first row sets them
    std::vector<std::vector<Cell>> rows = {};
    std::string note = {}; ///< below the table; empty = none

    /// Appends a row. All rows must have the same columns.
    void add(std::vector<Cell> row);
};

/// How html_of() writes a table.
struct TableLook {
    std::string_view css_class = {}; ///< "sortable" for buttons in its head and, above 20 rows, a filter
    /// Of a sortable table that has more rows, the first ones are HTML and all are data, of which the page's script
    /// makes rows while the reader scrolls.
    std::size_t max_html_rows = std::numeric_limits<std::size_t>::max();
};

/// Title, table and note as HTML, all text escaped. Cells that are numbers are aligned right. A table whose columns
/// have no names, such as one of names and values, has no head and is aligned left. Cells of the classes slower,
/// faster, no-change and unknown have a mark before their text.
std::string html_of(const ResultTable& table, const TableLook& look = {});

/// A table as comma-separated text: header, rows; cells with commas in quotes.
std::string csv_of(const ResultTable& table);

/// Tables as Markdown, separated by blank lines: title, table, note.
std::string markdown_of(std::span<const ResultTable> tables);

/// A table as LaTeX with the rules of the package booktabs: names of columns with their units (what follows the last
/// comma) in a line of their own, numbers aligned right, note below. Continues in a further tabular after 45 rows, as
/// many as a page takes. Letters beyond ASCII stay UTF-8.
std::string latex_of(const ResultTable& table);

/// Tables as JSON: a list of objects with "title", "rows" (an object a row, by column) and "note".
std::string json_of(std::span<const ResultTable> tables);

/// A table for the terminal: the first and the last column aligned left, all others right.
std::string text_of(const ResultTable& table);

enum class ColumnKind { Text, Hash, Truth, Whole, Number };

/// What a column of some type of row is called and how it is written, in every form.
struct ColumnHead {
    std::string_view key;  ///< in CSV, JSON and schema
    std::string_view name; ///< for people, with its unit
    ColumnKind kind = ColumnKind::Number;
    int decimals = 0;                 ///< below 0: so many significant digits instead
    std::string_view definition = {}; ///< a sentence for people and for the schema
    bool is_optional = false;         ///< some rows have no value: an empty cell, null in JSON
    bool is_signed = false;           ///< values may be below 0
};

/// A column of rows of a type. A list of them is the only description of that type: table, CSV, JSON and schema are
/// written from it.
template <class Row>
struct Column : ColumnHead {
    double (*value)(const Row&) = nullptr;     ///< of Truth, Whole and Number; not finite = no value
    std::string (*text)(const Row&) = nullptr; ///< of Text and Hash; an empty Hash = no value
};

/// Sixteen hexadecimal digits.
std::string hash_text(std::uint64_t hash);

namespace detail {

template <class Row, class Value>
Row row_of(Value Row::*);

template <class Row, class Value, class Function>
Row row_of(Value (Function::*)(const Row&) const);

template <class Function>
auto row_of(Function) -> decltype(row_of(&Function::operator()));

template <class Value>
double number_of(const Value& value) {
    if constexpr (requires { value.has_value(); }) {
        return value ? static_cast<double>(*value) : std::numeric_limits<double>::quiet_NaN();
    } else {
        return static_cast<double>(value);
    }
}

/// As RFC 4180: in quotes where it has commas, quotes or line ends.
std::string csv_field(std::string text);

std::string cell_text(const ColumnHead& head, double value);
base::JsonValue cell_json(const ColumnHead& head, double value);
base::JsonValue schema_of_column(const ColumnHead& head);

} // namespace detail

/// The column of a member, or of a function of a row: its kind follows from the type of its value; an optional number
/// makes an optional column.
template <auto Source>
constexpr auto column(std::string_view key, std::string_view name, int decimals = 0, std::string_view definition = {}) {
    using Row = decltype(detail::row_of(Source));
    using Value = std::remove_cvref_t<std::invoke_result_t<decltype(Source), const Row&>>;
    Column<Row> made;
    made.key = key;
    made.name = name;
    made.decimals = decimals;
    made.definition = definition;
    if constexpr (std::is_convertible_v<Value, std::string> || std::is_convertible_v<Value, std::string_view>) {
        made.kind = ColumnKind::Text;
        made.text = [](const Row& row) { return std::string(std::invoke(Source, row)); };
    } else {
        made.kind = std::is_same_v<Value, bool> ? ColumnKind::Truth
                    : std::is_integral_v<Value> ? ColumnKind::Whole
                                                : ColumnKind::Number;
        made.is_optional = requires(const Value& value) { value.has_value(); };
        if constexpr (requires(const Value& value) { value.has_value(); }) {
            using Number = typename Value::value_type;
            made.kind = std::is_integral_v<Number> ? ColumnKind::Whole : ColumnKind::Number;
        }
        made.value = [](const Row& row) { return detail::number_of(std::invoke(Source, row)); };
    }
    return made;
}

/// The same column, for values that may be below 0.
template <class SomeColumn>
constexpr SomeColumn with_sign(SomeColumn column) {
    column.is_signed = true;
    return column;
}

/// The column of a member that is a hash: std::uint64_t, optional or not.
template <auto Member>
constexpr auto hash_column(std::string_view key, std::string_view name, std::string_view definition = {}) {
    using Row = decltype(detail::row_of(Member));
    Column<Row> made;
    made.key = key;
    made.name = name;
    made.kind = ColumnKind::Hash;
    made.definition = definition;
    if constexpr (requires(const Row& row) { (row.*Member).has_value(); }) {
        made.is_optional = true;
        made.text = [](const Row& row) { return row.*Member ? hash_text(*(row.*Member)) : std::string(); };
    } else {
        made.text = [](const Row& row) { return hash_text(row.*Member); };
    }
    return made;
}

/// The cell of a row in CSV and tables.
template <class Row>
std::string text_of(const Column<Row>& column, const Row& row) {
    return column.text != nullptr ? column.text(row) : detail::cell_text(column, column.value(row));
}

/// The header line of a CSV file, with its line end.
template <class Columns>
std::string csv_header(const Columns& columns) {
    std::string line;
    for (const auto& each : columns) { line += fmt::format("{}{}", line.empty() ? "" : ",", each.key); }
    return line + "\n";
}

/// A row's line of a CSV file, with its line end.
template <class Columns, class Row>
std::string csv_line(const Columns& columns, const Row& row) {
    std::string line;
    bool is_first = true;
    for (const Column<Row>& each : columns) {
        line += std::exchange(is_first, false) ? "" : ",";
        line += detail::csv_field(text_of(each, row));
    }
    return line + "\n";
}

/// A row for JSON: numbers are not rounded.
template <class Columns, class Row>
base::JsonValue json_of(const Columns& columns, const Row& row) {
    base::JsonValue json;
    for (const Column<Row>& each : columns) {
        if (each.text == nullptr) {
            json[each.key] = detail::cell_json(each, each.value(row));
        } else {
            std::string text = each.text(row);
            const bool is_there = each.kind == ColumnKind::Text || !text.empty();
            json[each.key] = is_there ? base::JsonValue(std::move(text)) : base::JsonValue();
        }
    }
    return json;
}

/// Rows as a CSV file: header, a line each.
template <class Columns, class Rows>
std::string csv_rows(const Columns& columns, const Rows& rows) {
    std::string text = csv_header(columns);
    for (const auto& row : rows) { text += csv_line(columns, row); }
    return text;
}

/// Rows as a JSON list.
template <class Columns, class Rows>
base::JsonValue json_rows(const Columns& columns, const Rows& rows) {
    base::JsonValue list = base::JsonValue::list({});
    for (const auto& row : rows) { list.push_back(json_of(columns, row)); }
    return list;
}

/// The JSON schema of a row as json_of() writes it.
template <class Columns>
base::JsonValue schema_of(const Columns& columns) {
    base::JsonValue properties;
    auto required = base::JsonValue::list({});
    for (const ColumnHead& each : columns) {
        properties[each.key] = detail::schema_of_column(each);
        required.push_back(std::string(each.key));
    }
    return {{"type", "object"}, {"properties", properties}, {"required", required}, {"additionalProperties", false}};
}

/// A row for people.
template <class Columns, class Row>
std::vector<Cell> cells_of(const Columns& columns, const Row& row) {
    std::vector<Cell> cells;
    for (const Column<Row>& each : columns) { cells.emplace_back(std::string(each.name), text_of(each, row)); }
    return cells;
}

} // namespace octant::ui::report
