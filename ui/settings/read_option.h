#pragma once

#include "sim/base/error.h"
#include "ui/settings/settings_text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <string>

namespace octant::ui::settings {

/// Adds an option that is read like a setting of its type, within the bounds of `info`.
template <class Value>
CLI::Option* add_read_option(CLI::App& command, const FieldInfo& info, Value& value) {
    return command
        .add_option_function<std::string>(
            fmt::format("--{}", info.name),
            [info, &value](const std::string& text) {
                try {
                    read_setting(info, text, value);
                } catch (const Error& fault) {
                    throw Error(fmt::format("--{}", fault.what()));
                }
            },
            std::string(info.meaning))
        ->type_name(std::string(info.form));
}

} // namespace octant::ui::settings
