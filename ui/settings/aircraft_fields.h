#pragma once

#include "ui/settings/setting_row.h"

#include <tuple>

namespace octant::ui::settings {

/// Settings of the group Surface. How hidden surfaces of aircraft are removed, and with which
/// detail.
inline constexpr std::tuple surface_rows{
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::hidden_surface>(
        {"hidden-surface",
         "METHOD",
         "octant: painted in order, no depth buffer; depth-buffer; back-face: aircraft in file "
         "order"},
        {.group = SettingGroup::Surface, .change = SettingsChange::World}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::order_method>(
        {"order-method",
         "METHOD",
         "painting order of octant: tree (exact for every eye), cells (octants divided further) "
         "or paper (8 octants as printed); bsp divides polygons instead, exact for every eye"},
        {.group = SettingGroup::Surface, .change = SettingsChange::World}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::order_seconds>(
        {"order-seconds",
         "SECONDS",
         "cells, tree: about so long a model is searched; then its polygons are divided as by bsp",
         0.001,
         3600.0},
        {.group = SettingGroup::Surface, .change = SettingsChange::World}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::order_cache>(
        {"order-cache",
         "DIR",
         "painting orders and meshes made ready to be refined are kept in this folder, and read "
         "where the same model comes again: user (octant/orders in the user's cache), none or a "
         "folder"},
        {.group = SettingGroup::Surface, .change = SettingsChange::Recording}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::shadows>(
        {"shadows", "", "shadows of aircraft on the ground"},
        {.group = SettingGroup::Surface, .change = SettingsChange::Picture}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::effects>(
        {"effects", "", "rotor discs, exhaust, afterburners and vapour at the wingtips"},
        {.group = SettingGroup::Surface, .change = SettingsChange::Picture}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::aircraft_error_px>(
        {"aircraft-error-px",
         "PIXELS",
         "meshes: refined, or the coarsest level of a .chain, to be wrong by no more",
         0.01,
         100.0},
        {.group = SettingGroup::Surface, .change = SettingsChange::Picture})};

/// Settings of the group Shading. How aircraft are shaded.
inline constexpr std::tuple shading_rows{
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::kind>(
        {"shading",
         "KIND",
         "aircraft: flat, gouraud, hybrid (the polygons that gain most are smooth), or phong (lit "
         "in "
         "each pixel, with highlights)"},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::rule>(
        {"shading-rule",
         "RULE",
         "hybrid: error (area times squared error of flat shading) or paper (distance, "
         "intensities, perimeter)"},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::smooth_share>(
        {"smooth-share", "SHARE", "hybrid: share of the polygons that are smooth", 0.0, 1.0},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::device_ratio>(
        {"device-ratio",
         "RATIO",
         "hybrid: the same as the paper's speed of a device, 1 = all smooth [smooth-share]",
         0.0,
         1.0},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::near_m>(
        {"shading-near", "METRES", "paper's rule: all smooth to this distance", 0.0, 1e7},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::far_m>(
        {"shading-far", "METRES", "paper's rule: all flat from this distance", 0.0, 1e7},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::show_model>(
        {"show-model",
         "WHAT",
         "colours on aircraft: none, shading (smooth polygons blue, flat ones orange) or levels "
         "(a colour for each halving of what a mesh is wrong by, white where it is not)"},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture})};

} // namespace octant::ui::settings
