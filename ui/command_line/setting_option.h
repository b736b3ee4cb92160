#pragma once

#include "ui/command_line/command.h"
#include "ui/settings/settings.h"
#include "ui/settings/settings_text.h"

#include <fmt/format.h>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::command_line {

/// An option that reads its word as a setting of this type, within the bounds of `info`. Its name is that of `info`
/// after `dashes`. Help shows the default unless `info.meaning` ends with one in brackets.
template <class Value>
Option value_option(const settings::FieldInfo& info, Value& value, std::string_view dashes = "--") {
    const std::string name = fmt::format("{}{}", dashes, info.name);
    return {.name = name,
        .form = std::string(info.form),
        .meaning = std::string(info.meaning),
        .read =
            [name, info, &value](const Words& words) {
                settings::FieldInfo named = info;
                named.name = name; // in errors
                settings::read_setting(named, words.front(), value);
            },
        .shown_default = info.meaning.ends_with(']') ? "" : settings::text_of(value),
        .note =
            [name, &value](const Words& words) {
                return settings::old_name_note({name, {}, {}}, words.front(), value);
            }};
}

/// Adds --settings FILE and then one option for every setting, each under the heading of its group. The file is read
/// first, so that the others override it. The path is the argument without dashes. The names of given options are
/// appended to `given` unless it is null, as "--roads", "--no-roads", "path"; those of keys of a family, too. Settings
/// whose names are in `without` get no option. Rarely used settings are keys of a family (add_family); old names of
/// settings are read, with a note.
void add_setting_options(std::vector<Option>& table, settings::RunSettings& settings,
    std::vector<std::string>* given = nullptr, std::span<const std::string_view> without = {});

/// Adds --eye, --look, --size and --fov. `frame` says in which frame --eye and --look are.
void add_eye_options(std::vector<Option>& table, std::string_view frame, settings::EyeView& view);

/// --threads of computations whose results do not depend on it; its default is all processors.
Option threads_option(int& threads);

/// What map files do not say: --terrain-spacing, --height-scale, --terrain-system, --void and
/// --band. Every command that reads maps has them.
void add_file_options(std::vector<Option>& table, models::heights::ImportOptions& files);
void add_file_options(std::vector<Option>& table, settings::PathSettings& path);

} // namespace octant::ui::command_line
