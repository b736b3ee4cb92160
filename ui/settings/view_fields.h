#pragma once

#include "ui/settings/setting_row.h"

#include <array>
#include <tuple>

namespace octant::ui::settings {

/// How many samples of each pixel the renderers offer.
inline constexpr std::array sample_counts{1, 4, 16};

/// Bound on the coordinates of eye points: beyond every map.
inline constexpr double far_away_m = 1e7;

/// Settings of the group View. From where a picture is seen, how large it is and who draws it.
inline constexpr std::tuple view_rows{
    setting<&RunSettings::view, &visuals::scene::ViewSettings::kind>(
        {"view", "VIEW", "chase, cockpit, tower, orbit or free"},
        {.group = SettingGroup::View, .change = SettingsChange::Picture}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::eye_m>(
        {"eye",
         "X,Y,Z",
         "eye point of the tower and free views, metres east,north,up",
         -far_away_m,
         far_away_m},
        {.group = SettingGroup::View, .change = SettingsChange::Look}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::look_m>(
        {"look",
         "X,Y,Z",
         "what the free view looks at, metres east,north,up",
         -far_away_m,
         far_away_m},
        {.group = SettingGroup::View, .change = SettingsChange::Look}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::fov_deg>(
        {"fov",
         "DEGREES",
         "vertical field of view [45; the tower zooms in on the aircraft]",
         1.0,
         150.0},
        {.group = SettingGroup::View, .change = SettingsChange::Picture, .start = 45.0}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::azimuth_deg>(
        {"azimuth",
         "DEGREES",
         "chase, orbit: eye turned around the aircraft, clockwise from above; else the look "
         "turned right",
         -360.0,
         360.0},
        {.group = SettingGroup::View, .change = SettingsChange::Look}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::elevation_deg>(
        {"elevation",
         "DEGREES",
         "chase, orbit: eye turned upwards around the aircraft; else the look turned up",
         -89.0,
         89.0},
        {.group = SettingGroup::View, .change = SettingsChange::Look}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::zoom>(
        {"zoom",
         "FACTOR",
         "chase, orbit: how many times nearer; else how many times larger",
         0.05,
         100.0},
        {.group = SettingGroup::View, .change = SettingsChange::Look}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::inset>(
        {"inset", "VIEW", "a second view in a corner of the picture: chase, cockpit, ... [none]"},
        {.group = SettingGroup::View, .change = SettingsChange::Picture}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::head_up_display>(
        {"head-up-display", "", "speed, heading, pitch ladder and more before the cockpit view"},
        {.group = SettingGroup::View, .change = SettingsChange::Picture}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::path_ribbon>(
        {"path-ribbon",
         "",
         "the first aircraft's path as a ribbon with its legs named, a scale and a north mark"},
        {.group = SettingGroup::View, .change = SettingsChange::Picture}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::size_px>(
        {"size", "WIDTHxHEIGHT", "picture size in pixels", 16, 8192},
        {.group = SettingGroup::View, .change = SettingsChange::Picture, .set_by_window = true}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::samples>(
        {"samples", "N", "samples a pixel, 1, 4 or 16 [raster: 16, gl: 1]", 1, 16, sample_counts},
        {.group = SettingGroup::View, .change = SettingsChange::Picture, .start = 4.0}),
    setting<&RunSettings::drawing, &DrawingSettings::renderer>(
        {"renderer",
         "KIND",
         "who draws: raster (the program itself, no GPU), gl (OpenGL) or auto: raster where no GPU "
         "draws"},
        {.group = SettingGroup::View, .change = SettingsChange::World, .set_by_window = true}),
    setting<&RunSettings::drawing, &DrawingSettings::raster_threads>(
        {"raster-threads", "N", "threads of the raster renderer [one a core]", 1, 256},
        {.group = SettingGroup::View, .change = SettingsChange::World, .set_by_window = true}),
    setting<&RunSettings::drawing, &DrawingSettings::context>(
        {"context",
         "KIND",
         "OpenGL's context: osmesa (no GPU, no display), egl or window (the display's driver)"},
        {.group = SettingGroup::View, .change = SettingsChange::World, .set_by_window = true})};

} // namespace octant::ui::settings
