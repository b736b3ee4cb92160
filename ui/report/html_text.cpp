#include "ui/report/html_text.h"

#include "sim/base/text_file.h"

#include <algorithm>
#include <cstdint>

namespace octant::ui::report {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

/// Bytes of the UTF-8 character that `text` starts with, 0 when it starts with none.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    std::size_t length = 0;
    if (first < 0x80) {
        return 1;
    }
    if (first >= 0xC2 && first < 0xE0) {
        length = 2;
    } else if (first >= 0xE0 && first < 0xF0) {
        length = 3;
    } else if (first >= 0xF0 && first < 0xF5) {
        length = 4;
    }
    if (length == 0 || text.size() < length) {
        return 0;
    }
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U) {
            return 0;
        }
    }
    // Too long forms, surrogates and what lies past U+10FFFF.
    const unsigned second = byte(1);
    const bool bad = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                     (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
    return bad ? 0 : length;
}

void append_escaped(std::string& out, char c) {
    switch (c) {
    case '&':
        out += "&amp;";
        return;
    case '<':
        out += "&lt;";
        return;
    case '>':
        out += "&gt;";
        return;
    case '"':
        out += "&quot;";
        return;
    case '\'':
        out += "&#39;";
        return;
    default:
        break;
    }
    const auto byte = static_cast<unsigned char>(c);
    if ((byte >= 0x20 && byte != 0x7F) || c == '\n' || c == '\t') {
        out += c;
    }
}

bool is_number(const std::string& text) {
    return finite_number(text).has_value();
}

std::string row_html(const std::vector<std::string>& cells, std::size_t columns) {
    std::string html = "<tr>";
    for (std::size_t i = 0; i < columns; ++i) {
        const std::string cell = i < cells.size() ? cells[i] : "";
        html += is_number(cell) ? "<td class=\"number\">" : "<td>";
        html += escaped(cell) + "</td>";
    }
    return html + "</tr>\n";
}

} // namespace

std::string escaped(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 1) {
            append_escaped(out, text.front());
        } else {
            out += length == 0 ? replacement : text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t three = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto byte =
                at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0U;
            three = three << 8U | byte;
        }
        for (std::size_t i = 0; i < 4; ++i) {
            const bool filler = at + i > bytes.size();
            out += filler ? '=' : digits[three >> (18U - 6U * i) & 63U];
        }
    }
    return out;
}

std::string html_of(const HtmlTable& table) {
    std::size_t columns = table.header.size();
    for (const auto& row : table.rows) {
        columns = std::max(columns, row.size());
    }
    std::string html;
    if (!table.title.empty()) {
        html += "<h3>" + escaped(table.title) + "</h3>\n";
    }
    html += "<div class=\"scroll\"><table>\n";
    if (!table.header.empty()) {
        html += "<thead><tr>";
        for (std::size_t i = 0; i < columns; ++i) {
            const bool number =
                !table.rows.empty() && i < table.rows[0].size() && is_number(table.rows[0][i]);
            html += number ? "<th class=\"number\">" : "<th>";
            html += escaped(i < table.header.size() ? table.header[i] : "") + "</th>";
        }
        html += "</tr></thead>\n";
    }
    html += "<tbody>\n";
    for (const auto& row : table.rows) {
        html += row_html(row, columns);
    }
    html += "</tbody></table></div>\n";
    if (!table.note.empty()) {
        html += "<p class=\"note\">" + escaped(table.note) + "</p>\n";
    }
    return html;
}

} // namespace octant::ui::report
