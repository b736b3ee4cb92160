#include "ui/command_line/setting_option.h"

#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_file.h"
#include "ui/settings/settings_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::command_line {

using settings::RunSettings;
using settings::SettingInfo;

namespace {

/// The option that reads a setting. The path is the argument without dashes.
template <class Value>
Option option_of(const SettingInfo& info, Value& value) {
    return value_option(info, value, info.name == "path" ? "" : "--");
}

Option option_of(const SettingInfo& info, bool& value) {
    return with_shown_default(
        value ? "true" : "false", flag(fmt::format("--{0},!--no-{0}", info.name), std::string(info.meaning), value));
}

Option option_of(const SettingInfo& info, std::optional<bool>& value) {
    Option option{.name = fmt::format("--{0},!--no-{0}", info.name), .meaning = std::string(info.meaning)};
    option.arity = Arity::None;
    option.read = [&value](const Words& words) { value = words.front() == "true"; };
    return option;
}

Option option_of(const SettingInfo& info, std::vector<std::string>& values) {
    return with_shown_default(values.empty() ? std::string() : values.front(),
        list_option(fmt::format("--{}", info.name), std::string(info.form), std::string(info.meaning),
            Arity::Repeatable, values));
}

/// Settings that the program sets itself for others of its processes, or that only limit internal work.
constexpr std::array<std::string_view, 3> internal_settings{"part", "order-seconds", "raster-threads"};

/// Makes these options append their names to `given` when they are read: "--no-X" where a flag is taken back.
void record_given_options(std::span<Option> options, std::vector<std::string>& given) {
    for (Option& option : options) {
        const std::string name = option.name.substr(0, option.name.find(','));
        const bool is_flag = option.arity == Arity::None;
        option.read = [name, is_flag, read = option.read, &given](const Words& words) {
            const bool is_negated = is_flag && words.front() == "false";
            given.push_back(is_negated ? "--no-" + name.substr(2) : name);
            read(words);
        };
    }
}

/// Puts options that belong to a family into it.
void join_families(std::vector<Option>& table, std::vector<Option> options) {
    std::vector<std::vector<FamilyKey>> members(settings::setting_families().size());
    for (Option& option : options) {
        const std::string name = option.name.substr(0, option.name.find(','));
        bool has_family = false;
        for (std::size_t i = 0; i < members.size(); ++i) {
            for (const auto& [key, setting] : settings::setting_families()[i].keys) {
                if (name != fmt::format("--{}", setting)) { continue; }
                members[i].push_back({std::string(key), option});
                has_family = true;
            }
        }
        if (!has_family) { table.push_back(std::move(option)); }
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (members[i].empty()) { continue; }
        const settings::SettingFamily& family = settings::setting_families()[i];
        add_family(table,
            {.name = std::string(family.name),
                .form = std::string(family.form),
                .meaning = std::string(family.meaning),
                .heading = std::string(settings::name_of(family.group)),
                .shown = Shown::InHelpAll},
            std::move(members[i]));
    }
}

} // namespace

void add_setting_options(std::vector<Option>& table, RunSettings& settings, std::vector<std::string>* given,
    std::span<const std::string_view> without) {
    const auto notes = std::make_shared<std::vector<std::string>>();
    table.push_back({.name = "--settings",
        .form = "FILE",
        .meaning = "read settings from a file or a recording; other options override them",
        .read =
            [&settings, given, notes](const Words& words) {
                settings = settings::read_settings(words.front(), notes.get());
                if (given != nullptr) { given->emplace_back("--settings"); }
            },
        .note = [notes](const Words&) { return fmt::format("{}", fmt::join(*notes, "; ")); }});
    std::vector<Option> options;
    const auto is_left_out = [&](std::string_view name) { return std::ranges::find(without, name) != without.end(); };
    settings::visit_settings(settings, [&](const SettingInfo& info, auto& value) {
        if (is_left_out(info.name)) { return; }
        Option option = option_of(info, value);
        if (!info.known.empty()) {
            option.meaning = fmt::format("{}; {}", fmt::join(info.known, ", "), option.meaning);
        }
        option.heading = settings::name_of(info.group);
        option.shown = info.common ? Shown::InHelp : Shown::InHelpAll;
        if (std::ranges::find(internal_settings, info.name) != internal_settings.end()) { option.shown = Shown::Never; }
        options.push_back(std::move(option));
    });
    settings::visit_old_rows([&](const auto& row) {
        options.push_back(old_name(value_option(row, row.of(settings)),
            row.name == "mesh" ? "--terrain-lod screen-error, exact or paper[:roughness=midpoint]"
                               : fmt::format("--terrain-lod paper:{}={}", row.meaning, row.form)));
    });
    if (given != nullptr) { record_given_options(options, *given); }
    join_families(table, std::move(options));
}

void add_eye_options(std::vector<Option>& table, std::string_view frame, settings::EyeView& view) {
    constexpr double far_m = 1e9;
    Option eye = value_option({"eye", "X,Y,Z", "", -far_m, far_m}, view.eye_m);
    eye.meaning = fmt::format("eye point {}", frame);
    table.insert(table.end(),
        {std::move(eye),
            value_option({"look", "X,Y,Z", "point shown in the middle of the picture, in the same frame as --eye",
                             -far_m, far_m},
                view.look_m),
            value_option({"size", "WIDTHxHEIGHT", "picture size in pixels", 16, 16384}, view.size_px),
            value_option({"fov", "DEGREES", "vertical field of view", 0.1, 170.0}, view.fov_deg)});
}

Option threads_option(int& threads) {
    return value_option(
        {"threads", "N", "number of threads; the result does not depend on it [all processors]", 1, 1024}, threads);
}

namespace {

void add_file_rows(std::vector<Option>& table, double& spacing_m, std::optional<double>& height_scale,
    std::optional<std::string>& system, models::heights::VoidValues& voids, std::optional<std::string>& band) {
    table.insert(table.end(),
        {value_option(
             {"terrain-spacing", "METRES", "sample spacing in metres, for files that do not state it", 0.01, 1e5},
             spacing_m),
            value_option(
                {"height-scale", "METRES", "metres per height unit, for files that name no unit [1]", 1e-6, 1e4},
                height_scale),
            value_option({"terrain-system", "SYSTEM",
                             "coordinate system, for files that name none: EPSG:4326, a PROJ string, a .prj file or "
                             "metres [WGS 84 if the coordinates look like degrees, else metres]"},
                system),
            value_option(settings::void_info, voids), value_option(settings::band_info, band)});
}

} // namespace

void add_file_options(std::vector<Option>& table, models::heights::ImportOptions& files) {
    add_file_rows(table, files.spacing_m, files.height_scale, files.system, files.voids, files.band);
}

void add_file_options(std::vector<Option>& table, settings::PathSettings& path) {
    add_file_rows(table, path.terrain_spacing_m, path.terrain_height_scale, path.terrain_system, path.terrain_voids,
        path.terrain_band);
}

} // namespace octant::ui::command_line
