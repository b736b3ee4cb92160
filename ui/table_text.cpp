#include "ui/table_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace octant::ui {

std::string csv_of(const report::HtmlTable& table) {
    std::string text;
    const auto add = [&](const std::vector<std::string>& cells) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const bool quoted = cells[i].find(',') != std::string::npos;
            text += fmt::format(
                "{}{}{}{}", i == 0 ? "" : ",", quoted ? "\"" : "", cells[i], quoted ? "\"" : "");
        }
        text += "\n";
    };
    add(table.header);
    std::for_each(table.rows.begin(), table.rows.end(), add);
    return text;
}

std::string markdown_of(const report::HtmlTable& table) {
    std::string text = fmt::format("# {}\n\n", table.title);
    const auto add = [&](const std::vector<std::string>& cells) {
        text += "|";
        for (const std::string& cell : cells) {
            text += fmt::format(" {} |", cell);
        }
        text += "\n";
    };
    add(table.header);
    add(std::vector<std::string>(table.header.size(), "---"));
    std::for_each(table.rows.begin(), table.rows.end(), add);
    return text + "\n" + table.note + "\n";
}

} // namespace octant::ui
