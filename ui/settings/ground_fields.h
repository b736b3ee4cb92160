#pragma once

#include "ui/settings/setting_row.h"

#include <tuple>

namespace octant::ui::settings {

/// Settings of the group Ground. How the ground is refined.
inline constexpr std::tuple ground_rows{
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::mesh>(
        {"mesh",
         "METRIC",
         "what refines the ground: screen-error (error in pixels, bisection), or the paper's "
         "quadtree by midpoint or printed (corner slopes) roughness [screen-error; midpoint "
         "where only the quadtree has what is asked for]"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::propagation>(
        {"propagation",
         "RULE",
         "how roughness reaches coarser nodes: crack-free, or printed (leaves cracks)"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::fans>(
        {"fans", "KIND", "partial: quadrants refine singly; full: all four at once"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::detail>(
        {"detail",
         "CONTROL",
         "triangle control: exact (counted in each frame), damped (finds its own gain; with "
         "control-a the weighted mean as printed), previous, literal, or fixed C"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::triangles>(
        {"triangles",
         "N",
         "triangles of ground that are held [20000; no end with error-px]",
         100,
         10000000},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture, .start = 20000.0}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::error_px>(
        {"error-px",
         "PIXELS",
         "screen-error: refine to this error and no further [0.25, within the triangles]",
         0.01,
         1000.0},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture, .start = 1.0}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::geomorphs>(
        {"geomorphs", "", "screen-error: vertices move into place instead of jumping"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::mesh_async>(
        {"mesh-ahead",
         "",
         "screen-error: mesh the ground of the next frame while this one is drawn"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::earth_curvature>(
        {"earth-curvature", "", "screen-error: distant ground and aircraft sink by d^2 / 2R"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::resolution_c>(
        {"resolution-c",
         "C",
         "C of the first frame; 0 = what meets the target; not for exact",
         0.0,
         1e6},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::roughness_c>(
        {"roughness-c",
         "c",
         "weight of roughness against distance [20 for midpoint, 5 for printed]",
         0.0,
         1000.0},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture, .start = 20.0}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::control_a>(
        {"control-a",
         "a",
         "triangles a unit of C in the control; 0 = from the ground's own gain",
         0.0,
         1e9},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::near_detail>(
        {"near-detail",
         "",
         "screen-error: ground near the eye gets made-up detail between its samples; heights that "
         "are asked for have none"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::scenery>(
        {"scenery",
         "",
         "screen-error: made-up trees and houses near the eye; none where a texture colours the "
         "ground"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::roads>(
        {"roads",
         "",
         "screen-error: made-up roads along the valleys, with more houses beside them; none where "
         "a "
         "texture colours the ground"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::airfield>(
        {"airfield",
         "",
         "a runway of 1,800 x 45 m with its markings on levelled ground: where the path begins, "
         "along its first heading; near its first 15 km where that needs cuttings or embankments "
         "of more than 15 m; refused where all places within 6 km of it do. Heights that are asked "
         "for are those of the levelled ground"},
        {.group = SettingGroup::Ground, .change = SettingsChange::World}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::show_mesh>(
        {"show-mesh",
         "WHAT",
         "lines along the edges of the ground's triangles: none, edges, or levels (a colour for "
         "each halving of their size)"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::control_r>(
        {"control-r", "r", "earlier frames in the damping's mean", 0, 64},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture})};

} // namespace octant::ui::settings
