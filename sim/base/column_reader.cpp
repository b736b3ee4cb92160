#include "sim/base/column_reader.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <utility>

namespace octant {

char separator_of(std::string_view column_names) {
    const auto has = [&](char c) { return column_names.find(c) != std::string_view::npos; };
    if (has('\t')) { return '\t'; }
    return has(';') && !has(',') ? ';' : ',';
}

std::vector<std::string_view> table_fields(std::string_view row, char separator) {
    std::vector<std::string_view> fields;
    while (true) {
        const std::size_t begin = std::min(row.find_first_not_of(' '), row.size());
        std::size_t end = row.find(separator);
        if (begin < row.size() && row[begin] == '"') {
            const std::size_t quote = row.find('"', begin + 1);
            end = quote == std::string_view::npos ? end : row.find(separator, quote + 1);
        }
        std::string_view field = split_fields(row.substr(0, end), '\0').front();
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
            field = field.substr(1, field.size() - 2);
        }
        fields.push_back(field);
        if (end == std::string_view::npos) { return fields; }
        row.remove_prefix(end + 1);
    }
}

std::optional<std::size_t> field_named(
    std::span<const std::string_view> fields, std::string_view name, std::size_t begin) {
    const auto is_same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    for (std::size_t i = begin; i < fields.size(); ++i) {
        if (std::ranges::equal(fields[i], name, is_same)) { return i; }
    }
    return std::nullopt;
}

ColumnReader::ColumnReader(TextScanner lines, char separator) : lines_(std::move(lines)), separator_(separator) {}

bool ColumnReader::next_row() {
    while (lines_.next_line()) {
        const std::string_view line = lines_.line();
        const bool is_comment = line.starts_with('#');
        if (is_comment && !has_row_) { comment_ = line; }
        if (is_comment || split_words(line).empty()) { continue; }
        has_row_ = true;
        if (separator_ == '\0') { separator_ = separator_of(line); }
        fields_ = table_fields(line, separator_);
        return true;
    }
    return false;
}

void ColumnReader::find(std::span<const TableColumn> columns) {
    columns_.assign(columns.begin(), columns.end());
    name_count_ = fields_.size();
    field_of_.clear();
    for (const TableColumn& column : columns) {
        const auto field = column.name.empty() ? std::nullopt : field_named(fields_, column.name);
        if (field && field_named(fields_, column.name, *field + 1)) {
            refuse(fmt::format("column {} once", column.name), "it twice");
        }
        if (!field && column.is_required) { refuse(fmt::format("a column {}", column.name), in_quotes(row())); }
        field_of_.push_back(field);
    }
}

void ColumnReader::check_field_count() const {
    const std::size_t checked = std::min(name_count_, fields_.size());
    const bool is_rest_empty = std::ranges::all_of(std::span(fields_).subspan(checked), &std::string_view::empty);
    if (fields_.size() < name_count_ || !is_rest_empty) {
        refuse(fmt::format("{} fields", name_count_), std::to_string(fields_.size()));
    }
}

double ColumnReader::number(std::size_t i) const {
    const auto value = finite_number(text(i));
    if (!value) { refuse(fmt::format("a finite number in column {}", columns_[i].name), in_quotes(text(i))); }
    return *value;
}

} // namespace octant
