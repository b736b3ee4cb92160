#pragma once

#include "ui/commands/option.h"
#include "ui/settings/settings_text.h"

#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>

namespace octant::ui::commands {

template <class Value>
std::string default_text(const Value& value) {
    return settings::text_of(value);
}

template <class Value>
std::string default_text(const std::optional<Value>& value) {
    return value ? settings::text_of(*value) : "";
}

/// An option that is read as a setting of the type is, within the bounds of `info`, under the name of `info` behind
/// `dashes`. Its default is shown unless `info.meaning` ends with [words on it].
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
        .shown_default = info.meaning.ends_with(']') ? "" : default_text(value)};
}

} // namespace octant::ui::commands
