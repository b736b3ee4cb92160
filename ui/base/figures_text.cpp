#include "ui/base/figures_text.h"

#include "sim/base/error.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <fmt/format.h>

namespace octant::ui::base {

using Json = nlohmann::ordered_json;

namespace {

std::string value_text(const Json& value) {
    if (value.is_string()) {
        return printable(value.get<std::string>());
    }
    return value.is_number_float() ? fmt::format("{:.6g}", value.get<double>()) : value.dump();
}

} // namespace

std::string figures_text(const Json& figures) {
    std::size_t width = 0;
    for (const auto& [name, value] : figures.items()) {
        width = std::max(width, value.is_array() ? 0 : name.size());
    }
    std::string text;
    for (const auto& [name, value] : figures.items()) {
        if (value.is_array()) {
            for (const Json& line : value) {
                text += value_text(line) + "\n";
            }
        } else {
            text += fmt::format("{:<{}}  {}\n", name, width, value_text(value));
        }
    }
    return text;
}

std::string figures_json(const Json& figures) {
    return figures.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print_figures(const Json& figures, bool as_json) {
    std::fputs((as_json ? figures_json(figures) : figures_text(figures)).c_str(), stdout);
}

} // namespace octant::ui::base
