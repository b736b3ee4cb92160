#pragma once

#include "ui/base/data_files.h"
#include "ui/settings/setting_row.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>

namespace octant::ui::settings {

/// A text that a template takes as its argument.
template <std::size_t size>
struct FixedText {
    std::array<char, size> letters{};

    constexpr FixedText(const char (&text)[size]) { std::ranges::copy(text, letters.begin()); }

    constexpr std::string_view view() const { return {letters.data(), size - 1}; }
};

/// Calls `take` with the pieces of "before a, b, c after".
template <FixedText before, const auto& names, FixedText after>
constexpr void for_each_piece(auto take) {
    take(before.view());
    for (std::size_t i = 0; i < names.size(); ++i) {
        take(i > 0 ? std::string_view(", ") : std::string_view());
        take(names[i]);
    }
    take(after.view());
}

template <FixedText before, const auto& names, FixedText after>
inline constexpr auto joined_text_letters = [] {
    constexpr std::size_t size = [] {
        std::size_t sum = 0;
        for_each_piece<before, names, after>([&](std::string_view piece) { sum += piece.size(); });
        return sum;
    }();
    std::array<char, size> letters{};
    auto end = letters.begin();
    for_each_piece<before, names, after>([&](std::string_view piece) { end = std::ranges::copy(piece, end).out; });
    return letters;
}();

/// "before a, b, c after", put together when the program is compiled: help that lists names which stand elsewhere.
template <FixedText before, const auto& names, FixedText after>
inline constexpr std::string_view joined_text{
    joined_text_letters<before, names, after>.data(), joined_text_letters<before, names, after>.size()};

inline constexpr std::array<std::string_view, 4> built_in_terrains{"hills", "canyon", "background60", "none"};

/// Options of all commands that read maps.
inline constexpr FieldInfo void_info{"void", "V,...|none",
    "stored numbers meaning 'no data', in addition to the file's own; none: no number does, or "
    "only "
    "those that follow [common ones are recognised and noted]"};
inline constexpr FieldInfo band_info{"band", "N|NAME",
    "band that holds heights, or terrarium, mapbox for heights encoded in RGB [detected and "
    "noted]"};

/// Settings of the group Path. Which path, aircraft and ground.
inline constexpr std::tuple path_rows{
    setting<&RunSettings::path, &PathSettings::name>(
        {"path", "NAME|FILE",
            joined_text<"path: ", base::built_in_paths,
                ", a .toml, a recorded or logged .csv, .igc or .gpx, or a Tacview recording (.acmi)">},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight, .known = base::built_in_paths}),
    setting<&RunSettings::path, &PathSettings::aircraft>(
        {"aircraft", "NAME|FILE[=PATH[@Ns]]",
            joined_text<"aircraft: ", base::built_in_models,
                ", an OBJ file of up to 50,000 polygons (2,000 where nearly all are triangles) "
                "without pictures and glass, or a mesh (.obj, .ply, .stl, .glb, .ac, .wrl, .pm, "
                ".chain, FlightGear's .xml and what --version lists); repeat for wingmen, or =PATH "
                "for one with a path of its own, from N s on, such as 500md=turn@10s">},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight, .known = base::built_in_models}),
    setting<&RunSettings::path, &PathSettings::axes>(
        {"axes", "X,Y,Z|auto",
            "where the axes of aircraft files point, such as right,up,back; auto: as the format has "
            "it (AC3D, glTF), else guessed from the shape and said"},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight}),
    setting<&RunSettings::path, &PathSettings::terrain>(
        {"terrain", "NAME|FILE",
            joined_text<"ground: ", built_in_terrains,
                ", an imported ground, or any map that GDAL reads: a file, a folder or pattern of "
                "tiles, an archive">},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight, .known = built_in_terrains}),
    setting<&RunSettings::path, &PathSettings::terrain_spacing_m>(
        {"terrain-spacing", "METRES", "sample spacing of terrain files that do not say", 0.01, 1e5},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight}),
    setting<&RunSettings::path, &PathSettings::terrain_height_scale>(
        {"height-scale", "METRES",
            "metres a unit of heights, of terrain files that name no unit, such as 0.3048 for feet", 1e-6, 1e4},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight, .start = 1.0}),
    setting<&RunSettings::path, &PathSettings::terrain_system>(
        {"terrain-system", "SYSTEM",
            "coordinate system of terrain files that name none: EPSG:4326, a PROJ string, a .prj file "
            "or metres [degrees: WGS 84; else metres]"},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight}),
    setting<&RunSettings::path, &PathSettings::terrain_voids>(
        void_info, {.group = SettingGroup::Path, .change = SettingsChange::Flight}),
    setting<&RunSettings::path, &PathSettings::terrain_band>(
        band_info, {.group = SettingGroup::Path, .change = SettingsChange::Flight}),
    setting<&RunSettings::path, &PathSettings::place>(
        {"place", "X,Y|LAT,LON",
            "where the path's origin lies: metres east,north of the map centre, or degrees such as "
            "49.3N,123.1W or, on the map, 49.3,-123.1 [map centre]"},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight}),
    setting<&RunSettings::path, &PathSettings::heading_deg>(
        {"heading", "DEGREES",
            "turns the whole path, clockwise from the north of the map's grid [the heading of least "
            "relief]",
            -360.0, 360.0},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight}),
    setting<&RunSettings::path, &PathSettings::height_mode>(
        {"height-mode", "MODE",
            "clear: lift the path to its named clearance; follow: follow the ground; datum: as it "
            "is [clear; datum for a track with its own place]"},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight}),
    setting<&RunSettings::path, &PathSettings::lenient>(
        {"lenient", "", "clip legs that ask more than the aircraft can give, and say so"},
        {.group = SettingGroup::Path, .change = SettingsChange::Flight})};

} // namespace octant::ui::settings
