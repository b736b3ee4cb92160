#include "ui/base/json_value.h"

#include "sim/base/text_file.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>
#include <variant>

namespace octant::ui::base {

JsonValue& JsonValue::operator[](std::string_view name) {
    if (std::holds_alternative<std::monostate>(value_)) { value_ = JsonMembers(); }
    assert(std::holds_alternative<JsonMembers>(value_));
    auto& named = std::get<JsonMembers>(value_);
    const auto found = std::ranges::find(named, name, &JsonMembers::value_type::first);
    return found == named.end() ? named.emplace_back(std::string(name), JsonValue()).second : found->second;
}

void JsonValue::push_back(JsonValue member) {
    if (std::holds_alternative<std::monostate>(value_)) { value_ = List(); }
    assert(std::holds_alternative<List>(value_));
    std::get<List>(value_).push_back(std::move(member));
}

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

namespace {

constexpr std::string_view mark = "bytes:";

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0) { return false; }
        text.remove_prefix(length);
    }
    return true;
}

/// The value of a hexadecimal digit as json_from_file_name writes it, or -1.
int digit_of(char letter) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    const std::size_t at = digits.find(letter);
    return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

} // namespace

std::string json_from_file_name(const std::string& name) {
    if (is_utf8(name) && !name.starts_with(mark)) { return name; }
    std::string text(mark);
    for (const char letter : name) {
        const auto byte = static_cast<unsigned char>(letter);
        text += byte < 0x80 && letter != '%' ? std::string(1, letter) : fmt::format("%{:02X}", byte);
    }
    return text;
}

std::string file_name_from_json(const std::string& text) {
    if (!text.starts_with(mark)) { return text; }
    std::string name;
    for (std::size_t at = mark.size(); at < text.size(); ++at) {
        const bool pair =
            text[at] == '%' && at + 2 < text.size() && digit_of(text[at + 1]) >= 0 && digit_of(text[at + 2]) >= 0;
        if (pair) {
            name += static_cast<char>(16 * digit_of(text[at + 1]) + digit_of(text[at + 2]));
            at += 2;
        } else {
            name += text[at];
        }
    }
    return name;
}

} // namespace octant::ui::base
