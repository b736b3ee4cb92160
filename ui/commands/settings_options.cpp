#include "ui/commands/settings_options.h"

#include "ui/commands/read_option.h"
#include "ui/settings/settings_fields.h"
#include "ui/settings/settings_file.h"

#include <fmt/format.h>

namespace octant::ui::commands {

using settings::FieldInfo;
using settings::Settings;

namespace {

/// Makes an option of each setting that it is shown.
class OptionAdder {
public:
    explicit OptionAdder(std::vector<Option>& options)
        : options_(options) {}

    void begin_group(const char* heading) { heading_ = heading; }

    template <class Value>
    void operator()(const FieldInfo& info, Value& value) {
        add(read_option(info, value, info.name == "path" ? "" : "--"));
    }

    void operator()(const FieldInfo& info, bool& value) {
        add(showing(
            value ? "true" : "false",
            flag(fmt::format("--{0},!--no-{0}", info.name), std::string(info.meaning), value)));
    }

    void operator()(const FieldInfo& info, std::vector<std::string>& values) {
        add(showing(
            values.front(),
            list_option(
                fmt::format("--{}", info.name),
                std::string(info.form),
                std::string(info.meaning),
                Takes::OneWordAgain,
                values)));
    }

private:
    void add(Option option) {
        option.heading = heading_;
        options_.push_back(std::move(option));
    }

    std::vector<Option>& options_;
    std::string heading_;
};

void add_groups(Settings& settings, OptionAdder& adder) {
    adder.begin_group("Path, aircraft and ground");
    settings::visit_path_settings(settings, adder);
    adder.begin_group("View and picture");
    settings::visit_view_settings(settings, adder);
    adder.begin_group("Frames");
    settings::visit_time_settings(settings, adder);
    adder.begin_group("Hidden surfaces and detail of aircraft");
    settings::visit_surface_settings(settings, adder);
    adder.begin_group("Shading of aircraft");
    settings::visit_shading_settings(settings, adder);
    adder.begin_group("Terrain mesh");
    settings::visit_ground_settings(settings, adder);
    adder.begin_group("Sky, haze, sun and colours");
    settings::visit_air_settings(settings, adder);
}

} // namespace

void add_setting_options(std::vector<Option>& options, Settings& settings) {
    options.push_back(
        {.name = "--settings",
         .form = "FILE",
         .meaning =
             "take settings from FILE or from a recording's run.json; other options override "
             "them",
         .read = [&settings](const Words& words) {
             settings = settings::read_settings(words.front());
         }});
    OptionAdder adder(options);
    add_groups(settings, adder);
}

} // namespace octant::ui::commands
