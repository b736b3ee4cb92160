#include "ui/command_line/setting_option.h"

#include "ui/settings/settings_fields.h"
#include "ui/settings/settings_file.h"
#include "ui/settings/settings_text.h"

#include <fmt/format.h>
#include <span>
#include <string>
#include <utility>

namespace octant::ui::command_line {

using settings::RunSettings;
using settings::SettingInfo;

namespace {

/// Makes an option of each setting that it is shown.
class OptionAdder {
public:
    explicit OptionAdder(std::vector<Option>& options) : options_(options) {}

    template <class Value>
    void operator()(const SettingInfo& info, Value& value) {
        options_.push_back(option_of(info, value));
        options_.back().heading = settings::name_of(info.group);
    }

private:
    template <class Value>
    static Option option_of(const SettingInfo& info, Value& value) {
        return value_option(info, value, info.name == "path" ? "" : "--");
    }

    static Option option_of(const SettingInfo& info, bool& value) {
        return with_shown_default(value ? "true" : "false",
            flag(fmt::format("--{0},!--no-{0}", info.name), std::string(info.meaning), value));
    }

    static Option option_of(const SettingInfo& info, std::vector<std::string>& values) {
        return with_shown_default(values.front(), list_option(fmt::format("--{}", info.name), std::string(info.form),
                                                      std::string(info.meaning), Arity::Repeatable, values));
    }

    std::vector<Option>& options_;
};

/// Makes each of these options note its name when it is read.
void record_given_options(std::span<Option> options, std::vector<std::string>& given) {
    for (Option& option : options) {
        const std::string name = option.name.substr(0, option.name.find(','));
        option.read = [name, read = option.read, &given](const Words& words) {
            given.push_back(name);
            read(words);
        };
    }
}

} // namespace

void add_setting_options(std::vector<Option>& options, RunSettings& settings, std::vector<std::string>* given) {
    const std::size_t own = options.size();
    options.push_back({.name = "--settings",
        .form = "FILE",
        .meaning = "read settings from FILE or from a recording (run.json, folder or packed file); other options "
                   "override them",
        .read = [&settings](const Words& words) { settings = settings::read_settings(words.front()); }});
    settings::visit_settings(settings, OptionAdder(options));
    if (given != nullptr) { record_given_options(std::span(options).subspan(own), *given); }
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
