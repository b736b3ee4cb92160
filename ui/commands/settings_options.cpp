#include "ui/commands/settings_options.h"

#include "sim/base/error.h"
#include "ui/settings/settings_fields.h"
#include "ui/settings/settings_file.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace octant::ui::commands {

using settings::Settings;

namespace {

class OptionAdder {
public:
    OptionAdder(CLI::App& command, bool path_is_positional, std::string group)
        : command_(command)
        , path_is_positional_(path_is_positional)
        , group_(std::move(group)) {}

    template <class Value>
    void operator()(const settings::FieldInfo& info, Value& value) {
        const bool positional = path_is_positional_ && info.name == "path";
        const std::string name =
            positional ? std::string(info.name) : fmt::format("--{}", info.name);
        CLI::Option* option = command_.add_option_function<std::string>(
            name,
            [info, &value](const std::string& text) { read_option(info, text, value); },
            std::string(info.meaning));
        option->type_name(std::string(info.form))
            ->default_str(info.meaning.ends_with(']') ? "" : default_text(value))
            ->group(group_);
    }

    void operator()(const settings::FieldInfo& info, bool& value) {
        const std::string name = fmt::format("--{0},!--no-{0}", info.name);
        command_.add_flag(name, value, std::string(info.meaning))
            ->default_str(value ? "true" : "false")
            ->group(group_);
    }

    void operator()(const settings::FieldInfo& info, std::vector<std::string>& value) {
        command_
            .add_option_function<std::vector<std::string>>(
                fmt::format("--{}", info.name),
                [&value](const std::vector<std::string>& names) { value = names; },
                std::string(info.meaning))
            ->type_name(std::string(info.form))
            ->default_str(fmt::format("{}", value.front()))
            ->allow_extra_args(false)
            ->group(group_);
    }

private:
    template <class Value>
    static void
    read_option(const settings::FieldInfo& info, const std::string& text, Value& value) {
        try {
            settings::read_setting(info, text, value);
        } catch (const Error& fault) {
            throw Error(fmt::format("{}{}", info.name == "path" ? "" : "--", fault.what()));
        }
    }

    template <class Value>
    static std::string default_text(const Value& value) {
        return settings::text_of(value);
    }

    template <class Value>
    static std::string default_text(const std::optional<Value>& value) {
        return value ? settings::text_of(*value) : "";
    }

    CLI::App& command_;
    bool path_is_positional_;
    std::string group_;
};

} // namespace

void add_setting_options(CLI::App& command, Settings& settings, bool path_is_positional) {
    command
        .add_option_function<std::string>(
            "--settings",
            [&settings](const std::string& file) { settings = settings::read_settings(file); },
            "take settings from FILE or from a recording's run.json; other options override them")
        ->type_name("FILE");
    settings::visit_settings(settings, [&](const settings::SettingInfo& info, auto& value) {
        OptionAdder(command, path_is_positional, std::string(name_of(info.group)))(info, value);
    });
}

void add_number_option(CLI::App& command, const settings::FieldInfo& info, double& value) {
    OptionAdder(command, false, "Options")(info, value);
}

void add_number_option(CLI::App& command, const settings::FieldInfo& info, int& value) {
    OptionAdder(command, false, "Options")(info, value);
}

} // namespace octant::ui::commands
