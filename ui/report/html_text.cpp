#include "ui/report/html_text.h"

#include "sim/base/text_file.h"
#include "sim/base/utf8.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>

namespace octant::ui::report {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

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
    if ((byte >= 0x20 && byte != 0x7F) || c == '\n' || c == '\t') { out += c; }
}

bool is_number(const std::string& text) { return finite_number(text).has_value(); }

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

std::string url_text(std::string_view path) {
    constexpr std::string_view plain = "-._~/";
    std::string text;
    for (const char letter : path) {
        const bool stays = (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
                           (letter >= 'A' && letter <= 'Z') || plain.find(letter) != std::string_view::npos;
        text += stays ? std::string(1, letter) : fmt::format("%{:02X}", static_cast<unsigned char>(letter));
    }
    return text;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t three = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto byte = at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0U;
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
    for (const auto& row : table.rows) { columns = std::max(columns, row.size()); }
    std::string html;
    if (!table.title.empty()) { html += "<h3>" + escaped(table.title) + "</h3>\n"; }
    html += "<div class=\"scroll\"><table>\n";
    if (!table.header.empty()) {
        html += "<thead><tr>";
        for (std::size_t i = 0; i < columns; ++i) {
            const bool number = !table.rows.empty() && i < table.rows[0].size() && is_number(table.rows[0][i]);
            html += number ? "<th class=\"number\">" : "<th>";
            html += escaped(i < table.header.size() ? table.header[i] : "") + "</th>";
        }
        html += "</tr></thead>\n";
    }
    html += "<tbody>\n";
    for (const auto& row : table.rows) { html += row_html(row, columns); }
    html += "</tbody></table></div>\n";
    if (!table.note.empty()) { html += "<p class=\"note\">" + escaped(table.note) + "</p>\n"; }
    return html;
}

} // namespace octant::ui::report
