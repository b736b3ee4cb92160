#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>

namespace octant::ui::settings {

/// One value of an enumeration with the name that people write for it.
template <class Enum>
struct EnumName {
    Enum value;
    std::string_view name;
};

template <class Enum>
EnumName(Enum, std::string_view) -> EnumName<Enum>;

/// The names of an enumeration's values: an array of Named, specialised for each enumeration. The order of its rows
/// does not matter. A value without a name, or with two, does not compile.
template <class Enum>
inline constexpr std::array<EnumName<Enum>, 0> enum_names{};

/// A name that older versions wrote for a value; read until version 1.1, with a note that says its `meaning`.
template <class Enum>
struct OldEnumName {
    std::string_view name;
    Enum value;
    std::string_view meaning;
};

template <class Enum>
OldEnumName(std::string_view, Enum, std::string_view) -> OldEnumName<Enum>;

/// Old names of an enumeration's values: an array of OldEnumName, specialised for the few that have some.
template <class Enum>
inline constexpr std::array<OldEnumName<Enum>, 0> old_enum_names{};

/// Whether the enumeration declares an enumerator of this value. C++20 cannot ask that, but GCC and Clang say it where
/// they print a template's argument: as "Enum::Name", else as "(Enum)7".
template <auto value>
consteval bool is_enumerator() {
    std::string_view text = __PRETTY_FUNCTION__;
    text.remove_prefix(text.rfind("value = "));
    const std::size_t bracket = text.rfind(')');
    return bracket == std::string_view::npos || text.substr(bracket + 1).starts_with("::");
}

/// Whether the rows name each enumerator once, for an enumeration that counts from 0.
template <class Enum>
consteval bool names_each_value_once() {
    constexpr std::size_t count = enum_names<Enum>.size();
    std::array<int, count + 1> rows{};
    for (const EnumName<Enum>& row : enum_names<Enum>) {
        const auto value = static_cast<std::size_t>(row.value);
        if (value >= count || rows[value] > 0) { return false; }
        rows[value] = 1;
    }
    return !is_enumerator<static_cast<Enum>(count)>();
}

/// The names in the order of their values.
template <class Enum>
inline constexpr auto names_by_value = [] {
    static_assert(names_each_value_once<Enum>(), "enum_names must name each enumerator once");
    std::array<std::string_view, enum_names<Enum>.size()> names;
    for (const EnumName<Enum>& row : enum_names<Enum>) { names[static_cast<std::size_t>(row.value)] = row.name; }
    return names;
}();

/// The names of all values, each at the index of its value.
template <class Enum>
constexpr std::span<const std::string_view> names_of() {
    return names_by_value<Enum>;
}

/// The name of one value, which must be an enumerator.
template <class Enum>
requires std::is_enum_v<Enum>

constexpr std::string_view name_of(Enum value) { return names_by_value<Enum>.at(static_cast<std::size_t>(value)); }

} // namespace octant::ui::settings
