#pragma once

#include "ui/settings/settings.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::settings {

/// What a person may write for a setting; bounds are for numbers and include their ends.
struct FieldInfo {
    std::string_view name;    ///< of the option, without dashes, and of the key in settings files
    std::string_view form;    ///< shown in help: "METRES", "WIDTHxHEIGHT", ...
    std::string_view meaning; ///< one line for help, with the unit
    double least = 0.0;
    double most = 0.0;
};

/// Names of an enumeration's values in order, as written on the command line.
template <class Enum>
struct EnumNames;

/// A setting as text, in the form that read_setting takes. Exact: reading it back gives the value.
std::string text_of(const std::string& value);
std::string text_of(double value);
std::string text_of(int value);
std::string text_of(const glm::ivec2& value);
std::string text_of(const glm::dvec3& value);
std::string text_of(const glm::vec3& colour);
std::string text_of(const visuals::scene::Adaptation& adapt);

/// Reads a setting from text. Throws Error "NAME: expected ..., got ..." and leaves the value.
void read_setting(const FieldInfo& info, std::string_view text, std::string& value);
void read_setting(const FieldInfo& info, std::string_view text, double& value);
void read_setting(const FieldInfo& info, std::string_view text, int& value);
void read_setting(const FieldInfo& info, std::string_view text, bool& value);
void read_setting(const FieldInfo& info, std::string_view text, glm::ivec2& value);
void read_setting(const FieldInfo& info, std::string_view text, glm::dvec3& value);
void read_setting(const FieldInfo& info, std::string_view text, glm::vec3& colour);
void read_setting(const FieldInfo& info, std::string_view text, visuals::scene::Adaptation& adapt);

/// Index of `text` among `names`. Throws Error "NAME: expected one of ..., got ...".
std::size_t read_choice(
    const FieldInfo& info, std::string_view text, const std::vector<std::string_view>& names);

template <class Enum>

requires std::is_enum_v<Enum> std::string text_of(Enum value) {
    return std::string(EnumNames<Enum>::names().at(static_cast<std::size_t>(value)));
}

template <class Enum>
requires std::is_enum_v<Enum>

void read_setting(const FieldInfo& info, std::string_view text, Enum& value) {
    value = static_cast<Enum>(read_choice(info, text, EnumNames<Enum>::names()));
}

/// "none" unsets it.
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

template <>
struct EnumNames<visuals::scene::View> {
    static std::vector<std::string_view> names() {
        return {"chase", "cockpit", "tower", "orbit", "free"};
    }
};

template <>
struct EnumNames<HeightMode> {
    static std::vector<std::string_view> names() { return {"clear", "follow", "datum"}; }
};

template <>
struct EnumNames<ContextKind> {
    static std::vector<std::string_view> names() { return {"osmesa", "egl", "window"}; }
};

template <>
struct EnumNames<visuals::scene::GroundMetric> {
    static std::vector<std::string_view> names() { return {"printed", "midpoint", "screen-error"}; }
};

template <>
struct EnumNames<visuals::scene::Propagation> {
    static std::vector<std::string_view> names() { return {"crack-free", "printed"}; }
};

template <>
struct EnumNames<visuals::scene::GroundFans> {
    static std::vector<std::string_view> names() { return {"partial", "full"}; }
};

template <>
struct EnumNames<visuals::scene::DetailControl> {
    static std::vector<std::string_view> names() {
        return {"exact", "damped", "previous", "literal", "fixed"};
    }
};

template <>
struct EnumNames<visuals::scene::MeshLook> {
    static std::vector<std::string_view> names() { return {"none", "edges", "levels"}; }
};

template <>
struct EnumNames<visuals::scene::ModelLook> {
    static std::vector<std::string_view> names() { return {"none", "shading", "levels"}; }
};

template <>
struct EnumNames<visuals::scene::Palette> {
    static std::vector<std::string_view> names() { return {"temperate", "arid"}; }
};

template <>
struct EnumNames<visuals::scene::GroundShading> {
    static std::vector<std::string_view> names() { return {"auto", "vertex", "texture"}; }
};

template <>
struct EnumNames<visuals::scene::AircraftShading> {
    static std::vector<std::string_view> names() { return {"flat", "gouraud", "hybrid"}; }
};

template <>
struct EnumNames<visuals::scene::HybridRule> {
    static std::vector<std::string_view> names() { return {"error", "paper"}; }
};

template <>
struct EnumNames<visuals::scene::HiddenSurface> {
    static std::vector<std::string_view> names() { return {"octant", "depth-buffer", "back-face"}; }
};

template <>
struct EnumNames<visuals::draworder::Method> {
    static std::vector<std::string_view> names() { return {"paper", "cells", "tree"}; }
};

} // namespace octant::ui::settings
