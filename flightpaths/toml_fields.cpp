#include "flightpaths/toml_fields.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>
#include <utility>

namespace octant::flightpaths {

namespace {

struct Unit {
    std::string_view base;
    std::string_view name;
    double in_base;
};

constexpr std::array<Unit, 10> units{{
    {"m", "m", 1.0},
    {"m", "ft", m_from_ft(1.0)},
    {"mps", "mps", 1.0},
    {"mps", "kt", mps_from_kt(1.0)},
    {"rad", "deg", rad_from_deg(1.0)},
    {"radps", "degps", rad_from_deg(1.0)},
    {"rad_per_g", "deg_per_g", rad_from_deg(1.0)},
    {"s", "s", 1.0},
    {"g", "g", 1.0},
    {"mps2", "mps2", 1.0},
}};

std::string_view kind_of(const toml::node& node) {
    switch (node.type()) {
    case toml::node_type::table:
        return "a table";
    case toml::node_type::array:
        return "an array";
    case toml::node_type::string:
        return "a text";
    case toml::node_type::integer:
        return "a whole number";
    case toml::node_type::floating_point:
        return "a number";
    case toml::node_type::boolean:
        return "true or false";
    default:
        return "a date or time";
    }
}

std::string key_with(std::string_view name, std::string_view unit) {
    return unit.empty() ? std::string(name) : fmt::format("{}_{}", name, unit);
}

} // namespace

toml::table parse_toml(const std::filesystem::path& file, std::string_view text) {
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& fault) {
        throw_error_at(file, static_cast<int>(fault.source().begin.line),
            fmt::format("expected TOML, got a fault: {}", printable(std::string(fault.description()))));
    }
}

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

TomlFields::TomlFields(const std::filesystem::path& file, const toml::table& table)
    : file_(file), table_(table), line_(std::max(1, line_of(table))) {}

std::optional<double> TomlFields::number(std::string_view name, std::string_view base_unit, NumberRange bounds) {
    std::optional<double> value;
    std::string known_key;
    for (const Unit& unit : units) {
        if (unit.base != base_unit) { continue; }
        const std::string key = key_with(name, unit.name);
        const toml::node* node = take(key);
        if (node == nullptr) { continue; }
        if (value) { refuse(line_of(*node), fmt::format("expected one of {} and {}, got both", known_key, key)); }
        const double number = number_of(*node, key);
        value = number * unit.in_base;
        known_key = key;
        if (*value < bounds.min || *value > bounds.max) {
            refuse(line_of(*node), fmt::format("expected {} from {:.6g} to {:.6g}, got {:.6g}", key,
                                       bounds.min / unit.in_base, bounds.max / unit.in_base, number));
        }
    }
    return value;
}

double TomlFields::required_number(std::string_view name, std::string_view base_unit, NumberRange bounds) {
    if (const auto value = number(name, base_unit, bounds)) { return *value; }
    std::string keys;
    for (const Unit& unit : units) {
        if (unit.base == base_unit) { keys += (keys.empty() ? "" : " or ") + key_with(name, unit.name); }
    }
    refuse_missing(keys);
}

int TomlFields::required_integer(std::string_view name, int min, int max) {
    const toml::node* node = take(name);
    if (node == nullptr) { refuse_missing(name); }
    const auto value = node->value_exact<std::int64_t>();
    if (!value) {
        refuse(line_of(*node), fmt::format("expected {} to be a whole number, got {}", name, kind_of(*node)));
    }
    if (*value < min || *value > max) {
        refuse(line_of(*node), fmt::format("expected {} from {} to {}, got {}", name, min, max, *value));
    }
    return static_cast<int>(*value);
}

std::optional<std::string> TomlFields::text(std::string_view name) {
    const toml::node* node = take(name);
    if (node == nullptr) { return std::nullopt; }
    auto value = node->value_exact<std::string>();
    if (!value) { refuse(line_of(*node), fmt::format("expected {} to be a text, got {}", name, kind_of(*node))); }
    if (value->empty() || value->size() > 200 || printable(value->substr(0, 60)) != value->substr(0, 60)) {
        refuse(line_of(*node),
            fmt::format("expected {} to be a text of 1 to 200 plain characters, got \"{}\"", name, printable(*value)));
    }
    return value;
}

std::string TomlFields::required_text(std::string_view name) {
    if (auto value = text(name)) { return *value; }
    refuse_missing(name);
}

std::size_t TomlFields::required_word(std::string_view name, std::span<const std::string_view> words) {
    const std::string word = required_text(name);
    const auto found = std::ranges::find(words, word);
    if (found == words.end()) {
        refuse(line_of(*table_.get(name)),
            fmt::format("expected {} to be one of {}, got \"{}\"", name, fmt::join(words, ", "), printable(word)));
    }
    return static_cast<std::size_t>(found - words.begin());
}

const toml::table& TomlFields::required_table(std::string_view name) {
    const toml::node* node = take(name);
    if (node == nullptr) { refuse_missing(fmt::format("[{}]", name)); }
    if (!node->is_table()) {
        refuse(line_of(*node), fmt::format("expected a table [{}], got {}", name, kind_of(*node)));
    }
    return *node->as_table();
}

const toml::array& TomlFields::required_tables(std::string_view name) {
    const toml::node* node = take(name);
    if (node == nullptr) { refuse_missing(fmt::format("[[{}]]", name)); }
    const toml::array* tables = node->as_array();
    if (tables == nullptr || !tables->is_homogeneous(toml::node_type::table)) {
        std::string_view got = kind_of(*node);
        if (tables != nullptr) { got = tables->empty() ? "an empty array" : "an array of something else"; }
        refuse(line_of(*node), fmt::format("expected tables [[{}]], got {}", name, got));
    }
    return *tables;
}

void TomlFields::finish() const {
    for (const auto& [key, node] : table_) {
        if (requested_keys_.count(key.str()) == 0) {
            refuse(static_cast<int>(key.source().begin.line),
                fmt::format("expected a key that belongs here, got {}", printable(std::string(key.str()))));
        }
    }
}

void TomlFields::refuse(int line, const std::string& what) const { throw_error_at(file_, line, what); }

const toml::node* TomlFields::take(std::string_view key) {
    requested_keys_.emplace(key);
    return table_.get(key);
}

double TomlFields::number_of(const toml::node& node, std::string_view key) const {
    if (!node.is_number()) {
        refuse(line_of(node), fmt::format("expected {} to be a number, got {}", key, kind_of(node)));
    }
    const double number = node.value_or(0.0);
    if (!std::isfinite(number)) { refuse(line_of(node), fmt::format("expected {} to be finite, got {}", key, number)); }
    return number;
}

void TomlFields::refuse_missing(std::string_view key) const {
    refuse(line_, fmt::format("expected {}, got no such key", key));
}

} // namespace octant::flightpaths
