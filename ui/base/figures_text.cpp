#include "ui/base/figures_text.h"

#include "sim/base/utf8.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <variant>

namespace octant::ui::base {

using Json = nlohmann::ordered_json;

namespace {

Json json_of(const Figures& figures);

struct AsJson {
    Json operator()(std::monostate) const { return nullptr; }

    Json operator()(const Figures::List& list) const {
        auto json = Json::array();
        for (const Figures& member : list) {
            json.push_back(json_of(member));
        }
        return json;
    }

    Json operator()(const Figures::Named& named) const {
        auto json = Json::object();
        for (const auto& [name, figure] : named) {
            json[name] = json_of(figure);
        }
        return json;
    }

    template <class Plain>
    Json operator()(const Plain& plain) const {
        return plain;
    }
};

Json json_of(const Figures& figures) {
    return std::visit(AsJson(), figures.value());
}

} // namespace

std::string figure_text(const Figures& figure) {
    if (const auto* text = std::get_if<std::string>(&figure.value())) {
        return one_line(*text);
    }
    if (const auto* number = std::get_if<double>(&figure.value())) {
        return fmt::format("{:.6g}", *number);
    }
    return json_of(figure).dump();
}

std::string figures_text(const Figures& figures) {
    const auto* named = std::get_if<Figures::Named>(&figures.value());
    if (named == nullptr) {
        return figure_text(figures) + "\n";
    }
    std::size_t width = 0;
    for (const auto& [name, figure] : *named) {
        const bool in_column = !std::holds_alternative<Figures::List>(figure.value());
        width = std::max(width, in_column ? name.size() : 0);
    }
    std::string text;
    for (const auto& [name, figure] : *named) {
        if (const auto* list = std::get_if<Figures::List>(&figure.value())) {
            for (const Figures& member : *list) {
                text += figure_text(member) + "\n";
            }
        } else {
            text += fmt::format("{:<{}}  {}\n", name, width, figure_text(figure));
        }
    }
    return text;
}

std::string figures_json(const Figures& figures) {
    return json_of(figures).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print_figures(const Figures& figures, bool as_json) {
    std::fputs((as_json ? figures_json(figures) : figures_text(figures)).c_str(), stdout);
}

} // namespace octant::ui::base
