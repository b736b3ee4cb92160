#include "ui/report/table.h"

#include "sim/base/text_file.h"
#include "ui/report/html_text.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <nlohmann/json.hpp>
#include <utility>

namespace octant::ui::report {

namespace {

bool is_number(const Cell& cell) { return finite_number(cell.text).has_value(); }

/// "<td class="number soft">"; `element`: td or th.
std::string opened(std::string_view element, bool is_number, std::string_view css_class) {
    std::string classes = is_number ? "number" : "";
    if (!css_class.empty()) { classes += (classes.empty() ? "" : " ") + std::string(css_class); }
    return classes.empty() ? fmt::format("<{}>", element) : fmt::format("<{} class=\"{}\">", element, classes);
}

/// What stands before a cell's text, so that its colour is not all that tells.
std::string mark_html(std::string_view css_class) {
    constexpr std::array marks{std::pair{"slower", "\u25B2"}, std::pair{"faster", "\u25BC"},
        std::pair{"no-change", "="}, std::pair{"unknown", "?"}};
    for (const auto& [name, mark] : marks) {
        if (css_class == name) { return fmt::format("<span role=\"img\" aria-label=\"{}\">{}</span> ", name, mark); }
    }
    return {};
}

std::string cell_html(const Cell& cell, bool aligns_numbers) {
    const std::string text = mark_html(cell.css_class) + escaped(cell.text);
    const std::string linked =
        cell.link.empty() ? text : fmt::format("<a href=\"{}\">{}</a>", escaped(cell.link), text);
    return opened("td", aligns_numbers && is_number(cell), cell.css_class) + linked + "</td>";
}

/// A cell for the script: its text, or text, class and link. Classes that all cells of a column have are the column's.
std::string cell_json(const Cell& cell, std::string_view column_class) {
    const std::string_view own = cell.css_class == column_class ? std::string_view() : cell.css_class;
    const std::string text = script_string(cell.text);
    if (own.empty() && cell.link.empty()) { return text; }
    return fmt::format("[{},{},{}]", text, script_string(own), script_string(cell.link));
}

/// All rows of a table for the script, and the classes that all cells of a column have.
std::string rows_json(const ResultTable& table) {
    std::vector<std::string> column_classes;
    std::string classes;
    for (std::size_t i = 0; i < table.header.size(); ++i) {
        const Cell& first = table.rows.front()[i];
        const bool is_common =
            std::ranges::all_of(table.rows, [&](const auto& row) { return row[i].css_class == first.css_class; });
        column_classes.push_back(is_common ? first.css_class : std::string());
        classes += fmt::format("{}\"{} {}\"", i == 0 ? "" : ",", is_number(first) ? "number" : "", column_classes[i]);
    }
    std::string rows;
    for (const auto& row : table.rows) {
        rows += rows.empty() ? "[" : ",\n[";
        for (std::size_t i = 0; i < row.size(); ++i) {
            rows += (i == 0 ? "" : ",") + cell_json(row[i], column_classes[i]);
        }
        rows += "]";
    }
    return fmt::format("{{\"classes\":[{}],\"rows\":[{}]}}", classes, rows);
}

/// Where the rows are that a reader without script, or of paper, does not see. `shown`: rows that are HTML.
std::string left_out_html(std::size_t shown, std::size_t rows) {
    constexpr std::size_t max_printed_rows = 500; // as the page's style sheet and script have it
    constexpr std::string_view elsewhere = "A sweep's sweep.csv and octant report --json have all of them.";
    std::string html;
    if (shown < rows) {
        html += fmt::format("<noscript><p class=\"note\">The first {} of {} rows: the page's script makes the others. "
                            "{}</p></noscript>\n",
            shown, rows, elsewhere);
    }
    if (rows > max_printed_rows) {
        html += fmt::format("<p class=\"note print-only\">The first {} of {} rows are printed. {}</p>\n",
            max_printed_rows, rows, elsewhere);
    }
    return html;
}

std::string head_html(const ResultTable& table) {
    std::string html = "<thead><tr>";
    for (std::size_t i = 0; i < table.header.size(); ++i) {
        html +=
            opened("th", !table.rows.empty() && is_number(table.rows[0][i]), "") + escaped(table.header[i]) + "</th>";
    }
    return html + "</tr></thead>\n";
}

std::string line_of_markdown(const std::vector<std::string>& fields) {
    std::string line = "|";
    for (std::string field : fields) {
        for (std::size_t at = 0; (at = field.find('|', at)) != std::string::npos; at += 2) {
            field.insert(at, 1, '\\');
        }
        line += fmt::format(" {} |", field);
    }
    return line + "\n";
}

/// Text that LaTeX prints as it is, in any encoding of its fonts.
std::string latex_text(std::string_view text) {
    constexpr std::string_view special = "\\{}#$%&_^~<>|\"`-";
    constexpr std::array commands{"\\textbackslash{}", "\\{", "\\}", "\\#", "\\$", "\\%", "\\&", "\\_",
        "\\textasciicircum{}", "\\textasciitilde{}", "\\textless{}", "\\textgreater{}", "\\textbar{}", "{''}",
        "\\textasciigrave{}", "-{}"};
    std::string latex;
    for (const char letter : one_line(text)) {
        const std::size_t at = special.find(letter);
        latex += at == std::string_view::npos ? std::string(1, letter) : commands[at];
    }
    return latex;
}

/// A line of a LaTeX table; `text(i)` of each column.
template <class Text>
std::string latex_line(std::size_t columns, Text&& text) {
    std::string line;
    for (std::size_t i = 0; i < columns; ++i) { line += (i == 0 ? "" : " & ") + text(i); }
    return line + " \\\\\n";
}

/// Names of columns, and their units below them where there are any.
std::string latex_head(const std::vector<std::string>& names) {
    constexpr std::string_view separator = ", ";
    const auto comma = [&](std::size_t i) { return names[i].rfind(separator); };
    std::string head = latex_line(
        names.size(), [&](std::size_t i) { return latex_text(std::string_view(names[i]).substr(0, comma(i))); });
    const auto unit = [&](std::size_t i) {
        return comma(i) == std::string::npos ? std::string() : latex_text(names[i].substr(comma(i) + separator.size()));
    };
    const bool has_units =
        std::ranges::any_of(names, [&](const std::string& name) { return name.rfind(separator) != std::string::npos; });
    return has_units ? head + latex_line(names.size(), unit) : head;
}

std::vector<std::string> texts_of(const std::vector<Cell>& row) {
    std::vector<std::string> texts;
    for (const Cell& cell : row) { texts.push_back(cell.text); }
    return texts;
}

} // namespace

void ResultTable::add(std::vector<Cell> row) {
    if (rows.empty()) {
        header.clear();
        for (const Cell& cell : row) { header.push_back(cell.column); }
    }
    assert(std::ranges::equal(row, header, {}, &Cell::column));
    rows.push_back(std::move(row));
}

std::string html_of(const ResultTable& table, const TableLook& look) {
    constexpr std::size_t max_low_rows = 30; // more of them scroll in a box of their own
    std::string html;
    if (!table.title.empty()) { html += "<h3>" + escaped(table.title) + "</h3>\n"; }
    const bool is_sortable = look.css_class.find("sortable") != std::string_view::npos;
    const std::size_t shown = std::min(table.rows.size(), look.max_html_rows);
    html += fmt::format("<div class=\"scroll{}\">", is_sortable && table.rows.size() > max_low_rows ? " tall" : "");
    html += opened("table", false, look.css_class) + "\n";
    const bool is_named = std::ranges::any_of(table.header, [](const std::string& name) { return !name.empty(); });
    if (is_named) { html += head_html(table); }
    html += "<tbody>\n";
    for (const auto& row : std::span(table.rows).first(shown)) {
        html += "<tr>";
        for (const Cell& cell : row) { html += cell_html(cell, is_named); }
        html += "</tr>\n";
    }
    html += "</tbody></table>";
    if (shown < table.rows.size()) { html += "<script type=\"application/json\">" + rows_json(table) + "</script>"; }
    html += "</div>\n";
    if (is_sortable) { html += left_out_html(shown, table.rows.size()); }
    if (!table.note.empty()) { html += note_html(table.note); }
    return html;
}

std::string csv_of(const ResultTable& table) {
    std::string text;
    const auto add = [&](const std::vector<std::string>& fields) {
        for (const std::string& field : fields) {
            text += (&field == &fields.front() ? "" : ",") + detail::csv_field(field);
        }
        text += "\n";
    };
    add(table.header);
    for (const auto& row : table.rows) { add(texts_of(row)); }
    return text;
}

std::string markdown_of(std::span<const ResultTable> tables) {
    std::string text;
    for (const ResultTable& table : tables) {
        text += fmt::format("{}# {}\n\n", text.empty() ? "" : "\n", table.title) + line_of_markdown(table.header) +
                line_of_markdown(std::vector<std::string>(table.header.size(), "---"));
        for (const auto& row : table.rows) { text += line_of_markdown(texts_of(row)); }
        text += "\n" + table.note + "\n";
    }
    return text;
}

std::string latex_of(const ResultTable& table) {
    constexpr std::size_t rows_on_page = 45;
    std::string alignment;
    for (std::size_t i = 0; i < table.header.size(); ++i) {
        const bool is_right = std::ranges::all_of(
            table.rows, [&](const std::vector<Cell>& row) { return row[i].text.empty() || is_number(row[i]); });
        alignment += is_right ? "r" : "l";
    }
    std::string text = "{\\footnotesize\\setlength{\\tabcolsep}{3pt}\\noindent\n";
    for (std::size_t begin = 0; begin < table.rows.size(); begin += rows_on_page) {
        text += fmt::format("{}\\begin{{tabular}}{{@{{}}{}@{{}}}}\n\\toprule\n{}\\midrule\n",
            begin > 0 ? "\n\\medskip\\noindent\n" : "", alignment, latex_head(table.header));
        for (std::size_t r = begin; r < std::min(table.rows.size(), begin + rows_on_page); ++r) {
            const std::vector<Cell>& row = table.rows[r];
            text += latex_line(row.size(), [&](std::size_t i) {
                const bool is_negative = is_number(row[i]) && row[i].text.starts_with('-');
                return is_negative ? "$" + row[i].text + "$" : latex_text(row[i].text);
            });
        }
        text += "\\bottomrule\n\\end{tabular}\n";
    }
    if (!table.note.empty()) { text += "\n\\smallskip\\noindent\n" + latex_text(table.note) + "\n"; }
    return text + "\\par}\n";
}

std::string json_of(std::span<const ResultTable> tables) {
    auto list = nlohmann::ordered_json::array();
    for (const ResultTable& table : tables) {
        auto rows = nlohmann::ordered_json::array();
        for (const auto& cells : table.rows) {
            auto row = nlohmann::ordered_json::object();
            for (const Cell& cell : cells) {
                const auto number = finite_number(cell.text);
                row[cell.column] = number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json(cell.text);
            }
            rows.push_back(row);
        }
        list.push_back({{"title", table.title}, {"rows", rows}, {"note", table.note}});
    }
    return list.dump(2) + "\n";
}

std::string text_of(const ResultTable& table) {
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < table.header.size(); ++i) {
        widths.push_back(table.header[i].size());
        for (const auto& row : table.rows) { widths[i] = std::max(widths[i], row[i].text.size()); }
    }
    const auto line = [&](const std::vector<std::string>& fields) {
        std::string text;
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (i == 0) {
                text += fmt::format("{:<{}}", fields[i], widths[i]);
            } else {
                text += i + 1 == fields.size() ? "  " + fields[i] : fmt::format("  {:>{}}", fields[i], widths[i]);
            }
        }
        return text + "\n";
    };
    std::string text = line(table.header);
    for (const auto& row : table.rows) { text += line(texts_of(row)); }
    return text;
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

namespace detail {

std::string csv_field(std::string text) {
    if (text.find_first_of(",\"\n") == std::string::npos) { return text; }
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) { text.insert(at, 1, '"'); }
    return "\"" + text + "\"";
}

std::string cell_text(const ColumnHead& head, double value) {
    if (!std::isfinite(value)) { return {}; }
    return head.decimals < 0 ? fmt::format("{:.{}g}", value, -head.decimals)
                             : fmt::format("{:.{}f}", value, head.decimals);
}

base::JsonValue cell_json(const ColumnHead& head, double value) {
    if (!std::isfinite(value)) { return {}; }
    if (head.kind == ColumnKind::Truth) { return value != 0.0; }
    return head.kind == ColumnKind::Whole ? base::JsonValue(static_cast<std::int64_t>(value)) : base::JsonValue(value);
}

base::JsonValue schema_of_column(const ColumnHead& head) {
    static constexpr std::array names{"string", "string", "boolean", "integer", "number"};
    const std::string type = names[static_cast<std::size_t>(head.kind)];
    base::JsonValue schema;
    schema["type"] = head.is_optional ? base::JsonValue::list({type, "null"}) : base::JsonValue(type);
    if (head.kind == ColumnKind::Hash) { schema["pattern"] = "^[0-9a-f]{16}$"; }
    if (head.kind >= ColumnKind::Whole && !head.is_signed) { schema["minimum"] = 0; }
    if (!head.definition.empty()) { schema["description"] = std::string(head.definition); }
    return schema;
}

} // namespace detail

} // namespace octant::ui::report
