#include "ui/base/results_text.h"

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

Json json_of(const JsonValue& results);

struct AsJson {
    Json operator()(std::monostate) const { return nullptr; }

    Json operator()(const JsonValue::List& list) const {
        auto json = Json::array();
        for (const JsonValue& member : list) { json.push_back(json_of(member)); }
        return json;
    }

    Json operator()(const JsonValue::JsonMembers& named) const {
        auto json = Json::object();
        for (const auto& [name, json_value] : named) { json[name] = json_of(json_value); }
        return json;
    }

    template <class Plain>
    Json operator()(const Plain& plain) const {
        return plain;
    }
};

Json json_of(const JsonValue& results) { return std::visit(AsJson(), results.value()); }

} // namespace

std::string text_of_value(const JsonValue& json_value) {
    if (const auto* text = std::get_if<std::string>(&json_value.value())) { return one_line(*text); }
    if (const auto* number = std::get_if<double>(&json_value.value())) { return fmt::format("{:.6g}", *number); }
    return json_of(json_value).dump();
}

std::string text_of_results(const JsonValue& results) {
    const auto* named = std::get_if<JsonValue::JsonMembers>(&results.value());
    if (named == nullptr) { return text_of_value(results) + "\n"; }
    std::size_t width = 0;
    for (const auto& [name, json_value] : *named) {
        const bool in_column = !std::holds_alternative<JsonValue::List>(json_value.value());
        width = std::max(width, in_column ? name.size() : 0);
    }
    std::string text;
    for (const auto& [name, json_value] : *named) {
        if (const auto* list = std::get_if<JsonValue::List>(&json_value.value())) {
            for (const JsonValue& member : *list) { text += text_of_value(member) + "\n"; }
        } else {
            text += fmt::format("{:<{}}  {}\n", name, width, text_of_value(json_value));
        }
    }
    return text;
}

std::string json_of_results(const JsonValue& results) {
    return json_of(results).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print_value(const JsonValue& results, bool as_json) {
    std::fputs((as_json ? json_of_results(results) : text_of_results(results)).c_str(), stdout);
}

} // namespace octant::ui::base
