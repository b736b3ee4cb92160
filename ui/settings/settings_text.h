#pragma once

#include "ui/settings/enum_names.h"
#include "ui/settings/setting_names.h"
#include "ui/settings/settings.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace octant::ui::settings {

/// What a person may write for a setting or for another option that is read in the same way.
struct FieldInfo {
    /// Name of the option, without dashes, and of the key in settings files.
    std::string_view name;
    /// What help shows for the value: its unit ("METRES") or how it is written ("WIDTHxHEIGHT").
    std::string_view form;
    /// One line for help, with the unit where the form does not say it. Words in brackets at its
    /// end say what holds while the setting is not set.
    std::string_view meaning;
    /// The least and the greatest number that are taken.
    double min_value = 0.0;
    double max_value = 0.0;
    /// The only numbers that a whole-number setting takes; empty: all between the limits.
    std::span<const int> allowed_values{};
};

/// Returns a setting as text that read_setting takes. Reading it back gives exactly the value, for
/// colours the nearest with 8 bits a part.
std::string text_of(const std::string& value);
std::string text_of(double value);
std::string text_of(int value);
std::string text_of(const glm::ivec2& value);
std::string text_of(const glm::dvec3& value);
std::string text_of(const glm::vec3& colour);
std::string text_of(const visuals::scene::Adaptation& adapt);
std::string text_of(const models::heights::VoidValues& voids);

/// Reads a setting from text. Throws Error "NAME: expected ..., got ..." and then leaves the value
/// as it was.
void read_setting(const FieldInfo& info, std::string_view text, std::string& value);
void read_setting(const FieldInfo& info, std::string_view text, double& value);
void read_setting(const FieldInfo& info, std::string_view text, int& value);
void read_setting(const FieldInfo& info, std::string_view text, bool& value);
void read_setting(const FieldInfo& info, std::string_view text, glm::ivec2& value);
void read_setting(const FieldInfo& info, std::string_view text, glm::dvec3& value);
void read_setting(const FieldInfo& info, std::string_view text, glm::vec3& colour);
void read_setting(const FieldInfo& info, std::string_view text, visuals::scene::Adaptation& adapt);
void read_setting(const FieldInfo& info, std::string_view text, models::heights::VoidValues& voids);

/// Throws Error "NAME: expected ..., got ..." for a number that `info.allowed_values` does not list.
void check_listed(const FieldInfo& info, int value);

/// Returns the index of `text` among `names`. Throws Error "NAME: expected one of ..., got ...".
std::size_t read_choice(
    const FieldInfo& info, std::string_view text, const std::vector<std::string_view>& names);

template <class Enum>

requires std::is_enum_v<Enum> std::string text_of(Enum value) {
    return std::string(name_of(value));
}

template <class Enum>
requires std::is_enum_v<Enum>

void read_setting(const FieldInfo& info, std::string_view text, Enum& value) {
    const auto names = names_of<Enum>();
    value = static_cast<Enum>(read_choice(info, text, {names.begin(), names.end()}));
}

/// Reads an optional setting as one of its type; the text "none" unsets it.
template <class Value>
void read_setting(const FieldInfo& info, std::string_view text, std::optional<Value>& value) {
    if (text == "none") {
        value.reset();
        return;
    }
    Value read{};
    read_setting(info, text, read);
    value = std::move(read);
}

} // namespace octant::ui::settings
