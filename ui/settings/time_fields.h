#pragma once

#include "ui/settings/setting_row.h"

#include <tuple>

namespace octant::ui::settings {

/// Settings of the group Time. Which frames are drawn, and how fast.
inline constexpr std::tuple time_rows{
    setting<&RunSettings::time, &TimeSettings::rate_hz>(
        {"rate", "HZ", "frames a simulated second", 0.1, 1000.0},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording}),
    setting<&RunSettings::time, &TimeSettings::frame_per_sample>(
        {"frame-per-sample", "", "one frame a path sample, as the 1989 tables use"},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording}),
    setting<&RunSettings::time, &TimeSettings::start_s>(
        {"start", "S", "begin so far into the path", 0.0, 1e6},
        {.group = SettingGroup::Time, .change = SettingsChange::Flight}),
    setting<&RunSettings::time, &TimeSettings::part>(
        {"part",
         "K/N",
         "draw only the Kth of N parts of the frames, and the one before it, each as it is in the "
         "whole flight [all]"},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording}),
    setting<&RunSettings::time, &TimeSettings::frames>(
        {"frames", "N", "stop after so many frames [the whole path]", 1, 100000000},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording, .start = 600.0}),
    setting<&RunSettings::time, &TimeSettings::seconds>(
        {"seconds", "S", "stop after so much simulated time [the whole path]", 0.001, 1e6},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording, .start = 60.0}),
    setting<&RunSettings::time, &TimeSettings::warm_up>(
        {"warm-up", "N", "first frames that statistics leave out", 0, 1000000},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording}),
    setting<&RunSettings::time, &TimeSettings::realtime>(
        {"realtime", "", "no faster than the clock"},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording}),
    setting<&RunSettings::time, &TimeSettings::pictures>(
        {"pictures",
         "N",
         "with --record: every Nth frame as PNG, 0 = none [one a simulated second]",
         0,
         100000000},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording, .start = 60.0}),
    setting<&RunSettings::adapt>(
        {"adapt",
         "WHAT,...",
         "what follows the frame time: terrain (its triangles, from an eighth to four times "
         "--triangles, so that a frame uses 75 to 90 % of its time), shading (the share "
         "of smooth polygons, so that a frame keeps its time), or none"},
        {.group = SettingGroup::Time, .change = SettingsChange::Picture})};

} // namespace octant::ui::settings
