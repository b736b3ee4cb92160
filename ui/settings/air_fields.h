#pragma once

#include "ui/settings/setting_row.h"

#include <tuple>

namespace octant::ui::settings {

/// Settings of the group Air. Sky, haze, sun and the colours of the ground.
inline constexpr std::tuple air_rows{
    setting<&RunSettings::air, &visuals::scene::AirSettings::sky>(
        {"sky", "", "sky and the plain beyond the map's edge"},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::visibility_m>(
        {"visibility",
         "METRES",
         "distance at which haze leaves 1/e of a colour; 0 = no haze",
         0.0,
         1e7},
        {.group = SettingGroup::Air, .change = SettingsChange::Look}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::haze_height_m>(
        {"haze-height",
         "METRES",
         "so much higher up the haze is 1/e as dense; --visibility holds at the ground's mean "
         "height; 0 = as dense at all heights",
         0.0,
         1e6},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::background>(
        {"background",
         "RRGGBB",
         "colour of the empty picture, and of the haze; under a sky that of the haze with the sun "
         "35 degrees up, away from it"},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::time>(
        {"time",
         "YYYY-MM-DDTHH:MM",
         "date and the sun's own time, in place of the sun's angles: where it stands at the map's "
         "latitude, or at 45 degrees north without a place"},
        {.group = SettingGroup::Air, .change = SettingsChange::Light}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::sun_azimuth_deg>(
        {"sun-azimuth", "DEGREES", "sun, clockwise from north", -360.0, 360.0},
        {.group = SettingGroup::Air, .change = SettingsChange::Light}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::sun_elevation_deg>(
        {"sun-elevation", "DEGREES", "sun above the horizon", 0.0, 90.0},
        {.group = SettingGroup::Air, .change = SettingsChange::Light}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::relief_shadows>(
        {"relief-shadows", "", "shadows of the ground on itself, and less light in its hollows"},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::clouds>(
        {"clouds", "SHARE", "share of the sky that a thin layer of clouds covers", 0.0, 1.0},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::cloud_height_m>(
        {"cloud-height",
         "METRES",
         "of the clouds above datum, above all ground [500 m above the highest ground]",
         -1000.0,
         20000.0},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture, .start = 3000.0}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::water_level_m>(
        {"water-level", "METRES", "level ground at or below it is water", -12000.0, 9000.0},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::palette>(
        {"palette",
         "NAME",
         "ground colours: temperate or arid [arid for the canyon, else temperate]"},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::ground_shading>(
        {"ground-shading",
         "KIND",
         "vertex: ground lit at each vertex; texture: at each pixel, which without a GPU takes 2 "
         "to 3 times as long a frame; auto: texture with a drape or a GPU"},
        {.group = SettingGroup::Air, .change = SettingsChange::World}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::drape>(
        {"drape",
         "FILE",
         "image laid over the ground: by its coordinate system, or from edge to edge, north up, "
         "where it has none"},
        {.group = SettingGroup::Air, .change = SettingsChange::World})};

} // namespace octant::ui::settings
