#pragma once

#include "ui/settings/settings.h"
#include "visuals/draworder/order_method.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

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

/// A name that older versions wrote for a value; read until version 1.1. `meaning` ends the note
/// that tells of it.
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

/// The names in the order of their values. Named hidden, because GCC 12 forgets that for variable templates.
template <class Enum>
[[gnu::visibility("hidden")]] inline constexpr auto names_by_value = [] {
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

// Names of the values of every enumeration that settings use, as people write them.

template <>
inline constexpr std::array enum_names<visuals::scene::View>{EnumName{visuals::scene::View::Chase, "chase"},
    EnumName{visuals::scene::View::Cockpit, "cockpit"}, EnumName{visuals::scene::View::Tower, "tower"},
    EnumName{visuals::scene::View::Orbit, "orbit"}, EnumName{visuals::scene::View::Free, "free"}};

template <>
inline constexpr std::array enum_names<sim::HeightMode>{EnumName{sim::HeightMode::Clear, "clear"},
    EnumName{sim::HeightMode::Follow, "follow"}, EnumName{sim::HeightMode::Datum, "datum"}};

template <>
inline constexpr std::array enum_names<RendererKind>{
    EnumName{RendererKind::Auto, "auto"}, EnumName{RendererKind::Raster, "raster"}, EnumName{RendererKind::Gl, "gl"}};

template <>
inline constexpr std::array enum_names<ContextKind>{EnumName{ContextKind::OsMesa, "osmesa"},
    EnumName{ContextKind::Egl, "egl"}, EnumName{ContextKind::Window, "window"}};

template <>
inline constexpr std::array enum_names<visuals::terrain::GroundMetric>{
    EnumName{visuals::terrain::GroundMetric::Printed, "printed"},
    EnumName{visuals::terrain::GroundMetric::Midpoint, "midpoint"},
    EnumName{visuals::terrain::GroundMetric::ScreenError, "screen-error"}};

template <>
inline constexpr std::array enum_names<visuals::terrain::RoughnessPropagation>{
    EnumName{visuals::terrain::RoughnessPropagation::CrackFree, "crack-free"},
    EnumName{visuals::terrain::RoughnessPropagation::Printed, "printed"}};

template <>
inline constexpr std::array enum_names<visuals::terrain::FanKind>{
    EnumName{visuals::terrain::FanKind::Partial, "partial"}, EnumName{visuals::terrain::FanKind::Full, "full"}};

template <>
inline constexpr std::array enum_names<visuals::terrain::DetailControl>{
    EnumName{visuals::terrain::DetailControl::Exact, "exact"},
    EnumName{visuals::terrain::DetailControl::Damped, "damped"},
    EnumName{visuals::terrain::DetailControl::Previous, "previous"},
    EnumName{visuals::terrain::DetailControl::Literal, "literal"},
    EnumName{visuals::terrain::DetailControl::Fixed, "fixed"}};

template <>
inline constexpr std::array enum_names<visuals::scene::MeshDisplay>{EnumName{visuals::scene::MeshDisplay::None, "none"},
    EnumName{visuals::scene::MeshDisplay::Edges, "edges"}, EnumName{visuals::scene::MeshDisplay::Levels, "levels"}};

template <>
inline constexpr std::array enum_names<visuals::scene::ModelDisplay>{
    EnumName{visuals::scene::ModelDisplay::None, "none"}, EnumName{visuals::scene::ModelDisplay::Shading, "shading"},
    EnumName{visuals::scene::ModelDisplay::Levels, "levels"}};

template <>
inline constexpr std::array enum_names<visuals::scene::Palette>{
    EnumName{visuals::scene::Palette::Temperate, "temperate"}, EnumName{visuals::scene::Palette::Arid, "arid"}};

template <>
inline constexpr std::array enum_names<visuals::scene::GroundShading>{
    EnumName{visuals::scene::GroundShading::Auto, "auto"}, EnumName{visuals::scene::GroundShading::Vertex, "vertex"},
    EnumName{visuals::scene::GroundShading::Texture, "texture"}};

template <>
inline constexpr std::array enum_names<visuals::scene::AircraftShading>{
    EnumName{visuals::scene::AircraftShading::Flat, "flat"},
    EnumName{visuals::scene::AircraftShading::Gouraud, "gouraud"},
    EnumName{visuals::scene::AircraftShading::Hybrid, "hybrid"},
    EnumName{visuals::scene::AircraftShading::Phong, "phong"}};

template <>
inline constexpr std::array enum_names<visuals::scene::HybridRule>{
    EnumName{visuals::scene::HybridRule::Error, "error"}, EnumName{visuals::scene::HybridRule::Paper, "paper"}};

template <>
inline constexpr std::array enum_names<visuals::scene::HiddenSurface>{
    EnumName{visuals::scene::HiddenSurface::Octant, "octant"},
    EnumName{visuals::scene::HiddenSurface::DepthBuffer, "depth-buffer"},
    EnumName{visuals::scene::HiddenSurface::BackFace, "back-face"}};

template <>
inline constexpr std::array enum_names<visuals::draworder::OrderMethod>{
    EnumName{visuals::draworder::OrderMethod::Paper, "paper"},
    EnumName{visuals::draworder::OrderMethod::Exact, "exact"}};

template <>
inline constexpr std::array old_enum_names<visuals::draworder::OrderMethod>{
    OldEnumName{"tree", visuals::draworder::OrderMethod::Exact, "the old name of exact"},
    OldEnumName{
        "cells", visuals::draworder::OrderMethod::Exact, "only studied now (octant study draw-order); exact is used"},
    OldEnumName{
        "bsp", visuals::draworder::OrderMethod::Exact, "only studied now (octant study draw-order); exact is used"}};

template <>
inline constexpr std::array enum_names<visuals::draworder::OrderSource>{
    EnumName{visuals::draworder::OrderSource::Paper, "paper"},
    EnumName{visuals::draworder::OrderSource::Cells, "cells"}, EnumName{visuals::draworder::OrderSource::Tree, "tree"},
    EnumName{visuals::draworder::OrderSource::Parts, "parts"},
    EnumName{visuals::draworder::OrderSource::TreeAndSplitPolygons, "tree-and-parts"}};

/// One thing that can follow the frame time, with the name that people write for it.
struct AdaptationName {
    bool visuals::scene::Adaptation::*member;
    std::string_view name;
};

inline constexpr std::array adaptations{AdaptationName{&visuals::scene::Adaptation::terrain, "terrain"},
    AdaptationName{&visuals::scene::Adaptation::shading, "shading"}};

/// What a person may write for a setting or for another option that is read in the same way.
struct FieldInfo {
    /// Name of the option, without dashes, and of the key in settings files.
    std::string_view name;
    /// What help shows for the value: its unit ("METRES") or how it is written ("WIDTHxHEIGHT").
    std::string_view form;
    /// One line for help, with the unit where the form does not say it. Words in brackets at its end say what holds
    /// while the setting is not set.
    std::string_view meaning;
    /// The least and the greatest number that are taken.
    double min_value = 0.0;
    double max_value = 0.0;
    /// The only numbers that a whole-number setting takes; empty: all between the limits.
    std::span<const int> allowed_values{};
};

/// Returns a setting as text that read_setting takes. Reading it back gives exactly the value, for colours the nearest
/// with 8 bits a part.
std::string text_of(const std::string& value);
std::string text_of(double value);
std::string text_of(int value);
std::string text_of(const glm::ivec2& value);
std::string text_of(const glm::dvec3& value);
std::string text_of(const glm::vec3& colour);
std::string text_of(const visuals::scene::Adaptation& adapt);
std::string text_of(const models::heights::VoidValues& voids);
std::string text_of(const visuals::terrain::TerrainLod& lod);

/// Reads a setting from text. Throws Error "NAME: expected ..., got ..." and then leaves the value as it was.
void read_setting(const FieldInfo& info, std::string_view text, std::string& value);
void read_setting(const FieldInfo& info, std::string_view text, double& value);
void read_setting(const FieldInfo& info, std::string_view text, int& value);
void read_setting(const FieldInfo& info, std::string_view text, bool& value);
void read_setting(const FieldInfo& info, std::string_view text, glm::ivec2& value);
void read_setting(const FieldInfo& info, std::string_view text, glm::dvec3& value);
void read_setting(const FieldInfo& info, std::string_view text, glm::vec3& colour);
void read_setting(const FieldInfo& info, std::string_view text, visuals::scene::Adaptation& adapt);
void read_setting(const FieldInfo& info, std::string_view text, models::heights::VoidValues& voids);
void read_setting(const FieldInfo& info, std::string_view text, visuals::terrain::TerrainLod& lod);

/// Throws Error "NAME: expected ..., got ..." for a number that `info.allowed_values` does not list.
void check_listed(const FieldInfo& info, int value);

/// Returns the index of `text` among `names`. Throws Error "NAME: expected one of ..., got ...".
std::size_t read_choice(const FieldInfo& info, std::string_view text, const std::vector<std::string_view>& names);

/// The note "NAME: 'tree' is the old name of exact".
std::string old_name_note(std::string_view name, std::string_view text, std::string_view meaning);

/// The note for a text that read_setting() takes for a value of this type, if it is an old name; else an empty string.
template <class Value>
std::string old_name_note(const FieldInfo& info, std::string_view text, const Value&) {
    if constexpr (std::is_enum_v<Value>) {
        for (const OldEnumName<Value>& old : old_enum_names<Value>) {
            if (text == old.name) { return old_name_note(info.name, text, old.meaning); }
        }
    }
    return {};
}

template <class Enum>

requires std::is_enum_v<Enum> std::string text_of(Enum value) { return std::string(name_of(value)); }

template <class Enum>
requires std::is_enum_v<Enum>

void read_setting(const FieldInfo& info, std::string_view text, Enum& value) {
    for (const OldEnumName<Enum>& old : old_enum_names<Enum>) {
        if (text == old.name) {
            value = old.value;
            return;
        }
    }
    const auto names = names_of<Enum>();
    value = static_cast<Enum>(read_choice(info, text, {names.begin(), names.end()}));
}

/// Empty if it is not set.
template <class Value>
std::string text_of(const std::optional<Value>& value) {
    return value ? text_of(*value) : std::string();
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
