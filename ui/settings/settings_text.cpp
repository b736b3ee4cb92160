#include "ui/settings/settings_text.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <utility>

namespace octant::ui::settings {

using visuals::scene::Adaptation;

namespace {

/// Words for VoidValues: "none" counts only the numbers that follow it, "common" is the default.
constexpr std::string_view no_voids = "none";
constexpr std::string_view common_voids = "common";

[[noreturn]] void refuse(const FieldInfo& info, const std::string& expected, std::string_view got) {
    throw Error(fmt::format("{}: expected {}, got '{}'", info.name, expected, printable(std::string(got))));
}

std::string range_of(const FieldInfo& info, std::string_view kind) {
    return fmt::format("{} from {} to {}", kind, info.min_value, info.max_value);
}

std::string adaptation_names() {
    std::vector<std::string_view> names;
    for (const AdaptationName& each : adaptations) { names.push_back(each.name); }
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Reads exactly `numbers.size()` finite numbers between separators; false for any other text.
bool read_numbers(std::string_view text, char separator, std::span<double> numbers) {
    const auto fields = split_fields(text, separator);
    if (fields.size() != numbers.size()) { return false; }
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const auto number = finite_number(fields[i]);
        if (!number) { return false; }
        numbers[i] = *number;
    }
    return true;
}

} // namespace

std::string text_of(const std::string& value) { return value; }

std::string text_of(double value) { return fmt::format("{}", value); }

std::string text_of(int value) { return fmt::format("{}", value); }

std::string text_of(const glm::ivec2& value) { return fmt::format("{}x{}", value.x, value.y); }

std::string text_of(const glm::dvec3& value) { return fmt::format("{},{},{}", value.x, value.y, value.z); }

std::string text_of(const glm::vec3& colour) {
    return fmt::format("{:02x}{:02x}{:02x}", std::lround(colour.x * 255.0F), std::lround(colour.y * 255.0F),
        std::lround(colour.z * 255.0F));
}

std::string text_of(const Adaptation& adapt) {
    std::string text;
    for (const auto& [member, name] : adaptations) {
        if (adapt.*member) {
            text += text.empty() ? "" : ",";
            text += name;
        }
    }
    return text;
}

std::string text_of(const models::heights::VoidValues& voids) {
    std::vector<std::string> words;
    if (voids.only) { words.emplace_back(no_voids); }
    for (const double value : voids.values) { words.push_back(text_of(value)); }
    return words.empty() ? std::string(common_voids) : fmt::format("{}", fmt::join(words, ","));
}

void read_setting(const FieldInfo& info, std::string_view text, std::string& value) {
    if (text.empty()) { refuse(info, "a name or a file", text); }
    value = text;
}

void read_setting(const FieldInfo& info, std::string_view text, double& value) {
    const auto number = finite_number(text);
    if (!number || *number < info.min_value || *number > info.max_value) {
        refuse(info, range_of(info, "a number"), text);
    }
    value = *number;
}

void read_setting(const FieldInfo& info, std::string_view text, int& value) {
    const auto number = whole_number(text);
    if (!number || static_cast<double>(*number) < info.min_value || static_cast<double>(*number) > info.max_value) {
        refuse(info, range_of(info, "a whole number"), text);
    }
    check_listed(info, static_cast<int>(*number));
    value = static_cast<int>(*number);
}

void read_setting(const FieldInfo& info, std::string_view text, bool& value) {
    if (text != "true" && text != "false") { refuse(info, "true or false", text); }
    value = text == "true";
}

void read_setting(const FieldInfo& info, std::string_view text, glm::ivec2& value) {
    std::array<double, 2> numbers{};
    const bool read = read_numbers(text, 'x', numbers);
    for (const double number : numbers) {
        if (!read || number != std::floor(number) || number < info.min_value || number > info.max_value) {
            refuse(info, fmt::format("WIDTHxHEIGHT, each {} to {}", info.min_value, info.max_value), text);
        }
    }
    value = {static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
}

void read_setting(const FieldInfo& info, std::string_view text, glm::dvec3& value) {
    std::array<double, 3> numbers{};
    if (!read_numbers(text, ',', numbers)) { refuse(info, "X,Y,Z", text); }
    for (const double number : numbers) {
        if (number < info.min_value || number > info.max_value) {
            refuse(info, fmt::format("X,Y,Z, each {} to {}", info.min_value, info.max_value), text);
        }
    }
    value = {numbers[0], numbers[1], numbers[2]};
}

void read_setting(const FieldInfo& info, std::string_view text, glm::vec3& colour) {
    unsigned packed = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), packed, 16);
    if (text.size() != 6 || code != std::errc() || end != text.data() + text.size()) {
        refuse(info, "six hexadecimal digits RRGGBB", text);
    }
    const auto part = [packed](unsigned shift) { return static_cast<float>((packed >> shift) & 0xffU) / 255.0F; };
    colour = {part(16U), part(8U), part(0U)};
}

void read_setting(const FieldInfo& info, std::string_view text, Adaptation& adapt) {
    Adaptation read;
    if (!text.empty() && text != "none") {
        for (const std::string_view word : split_fields(text, ',')) {
            const auto found = std::ranges::find(adaptations, word, &AdaptationName::name);
            if (found == adaptations.end()) {
                refuse(info, fmt::format("none or a list of {}", adaptation_names()), text);
            }
            read.*found->member = true;
        }
    }
    adapt = read;
}

void read_setting(const FieldInfo& info, std::string_view text, models::heights::VoidValues& voids) {
    models::heights::VoidValues read;
    for (const std::string_view word : split_fields(text, ',')) {
        const auto number = finite_number(word);
        if (number) {
            read.values.push_back(*number);
        } else if (word == no_voids) {
            read.only = true;
        } else if (text != common_voids) {
            refuse(info, "numbers with commas between them, or none", text);
        }
    }
    voids = read;
}

void check_listed(const FieldInfo& info, int value) {
    if (!info.allowed_values.empty() && std::ranges::find(info.allowed_values, value) == info.allowed_values.end()) {
        const auto all = info.allowed_values;
        throw Error(fmt::format(
            "{}: expected {} or {}, got {}", info.name, fmt::join(all.first(all.size() - 1), ", "), all.back(), value));
    }
}

std::string old_name_note(std::string_view name, std::string_view text, std::string_view meaning) {
    return fmt::format("{}: '{}' is {}", name, text, meaning);
}

std::size_t read_choice(const FieldInfo& info, std::string_view text, const std::vector<std::string_view>& names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == text) { return i; }
    }
    refuse(info, fmt::format("one of {}", fmt::join(names, ", ")), text);
}

} // namespace octant::ui::settings
