#include "ui/report/table_text.h"

#include "sim/base/text_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vector>

namespace octant::ui::report {

std::string csv_of(const report::HtmlTable& table) {
    std::string text;
    const auto add = [&](const std::vector<std::string>& cells) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const bool quoted = cells[i].find(',') != std::string::npos;
            text += fmt::format("{}{}{}{}", i == 0 ? "" : ",", quoted ? "\"" : "", cells[i], quoted ? "\"" : "");
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
        for (const std::string& cell : cells) { text += fmt::format(" {} |", cell); }
        text += "\n";
    };
    add(table.header);
    add(std::vector<std::string>(table.header.size(), "---"));
    std::for_each(table.rows.begin(), table.rows.end(), add);
    return text + "\n" + table.note + "\n";
}

std::string json_of(std::span<const report::HtmlTable> tables) {
    auto list = nlohmann::ordered_json::array();
    for (const report::HtmlTable& table : tables) {
        auto rows = nlohmann::ordered_json::array();
        for (const auto& cells : table.rows) {
            auto row = nlohmann::ordered_json::object();
            for (std::size_t i = 0; i < cells.size() && i < table.header.size(); ++i) {
                const auto number = finite_number(cells[i]);
                row[table.header[i]] = number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json(cells[i]);
            }
            rows.push_back(row);
        }
        list.push_back({{"title", table.title}, {"rows", rows}, {"note", table.note}});
    }
    return list.dump(2) + "\n";
}

} // namespace octant::ui::report
