#include "ui/settings/settings_fields.h"
#include "ui/window/setting_widgets.h"

#include <catch2/catch.hpp>

#include <type_traits>

using namespace octant;
using ui::settings::RunSettings;
using ui::settings::SettingInfo;
using ui::window::NumberStyle;

namespace {

/// What the list of settings says of one.
SettingInfo info_of(std::string_view name) {
    SettingInfo found{};
    RunSettings settings;
    ui::settings::visit_settings(settings, [&](const SettingInfo& info, const auto&) {
        if (info.name == name) { found = info; }
    });
    REQUIRE(found.name == name);
    return found;
}

template <class Value>
struct OptionalNumber : std::false_type {};

template <>
struct OptionalNumber<std::optional<int>> : std::true_type {};

template <>
struct OptionalNumber<std::optional<double>> : std::true_type {};

} // namespace

TEST_CASE("numbers over many decades get logarithmic sliders, wide ones around zero are dragged") {
    CHECK(ui::window::number_style(info_of("triangles")) == NumberStyle::LogSlider);
    CHECK(ui::window::number_style(info_of("visibility")) == NumberStyle::LogSlider);
    CHECK(ui::window::number_style(info_of("error-px")) == NumberStyle::LogSlider);
    CHECK(ui::window::number_style(info_of("control-r")) == NumberStyle::Slider);
    CHECK(ui::window::number_style(info_of("sun-azimuth")) == NumberStyle::Slider);
    CHECK(ui::window::number_style(info_of("sun-elevation")) == NumberStyle::Slider);
    CHECK(ui::window::number_style(info_of("water-level")) == NumberStyle::Drag);
}

TEST_CASE("numbers that load the world anew wait for Enter") {
    CHECK(ui::window::number_style(info_of("heading")) == NumberStyle::Typed);
    CHECK(ui::window::number_style(info_of("terrain-spacing")) == NumberStyle::Typed);
}

TEST_CASE("optional numbers begin within their bounds") {
    RunSettings settings;
    ui::settings::visit_settings(settings, [](const SettingInfo& info, const auto& value) {
        if constexpr (OptionalNumber<std::decay_t<decltype(value)>>::value) {
            CAPTURE(info.name);
            CHECK(ui::window::start_value(info) >= info.min_value);
            CHECK(ui::window::start_value(info) <= info.max_value);
        }
    });
    CHECK(ui::window::start_value(info_of("fov")) == 45.0);
    CHECK(ui::window::start_value(info_of("triangles")) == 20000.0);
}

TEST_CASE("what an unset setting means is read from its brackets") {
    CHECK(ui::window::unset_meaning(info_of("place")) == "map centre");
    CHECK(ui::window::unset_word(info_of("place")) == "auto");
    CHECK(ui::window::unset_word(info_of("inset")) == "none");
    CHECK(ui::window::unset_word(info_of("drape")) == "none");
    CHECK(ui::window::unset_meaning(info_of("drape")).empty());
}

TEST_CASE("a tooltip says meaning, option, the paper's letter and bounds") {
    CHECK(
        ui::window::tooltip_of(info_of("control-r")) == "earlier frames in the damping's mean\n--control-r r, 0 to 64");
    CHECK(ui::window::tooltip_of(info_of("sky")) == "sky and the plain beyond the map's edge\n--sky");
}

TEST_CASE("names go into one line of text and come back") {
    const std::vector<std::string> names{"f15", "my model.obj"};
    CHECK(ui::window::comma_separated(names) == "f15, my model.obj");
    CHECK(ui::window::split_at_commas(ui::window::comma_separated(names)) == names);
    CHECK(ui::window::split_at_commas(" f15 ,, 500md,") == std::vector<std::string>{"f15", "500md"});
    CHECK(ui::window::split_at_commas(" , ").empty());
}

TEST_CASE("wingmen come as copies of the leader and go from the end") {
    const std::vector<std::string> two{"f15", "500md"};
    CHECK(ui::window::with_aircraft_count(two, 4) == std::vector<std::string>{"f15", "500md", "f15", "f15"});
    CHECK(ui::window::with_aircraft_count(two, 1) == std::vector<std::string>{"f15"});
    CHECK(ui::window::with_aircraft_count(two, 0) == std::vector<std::string>{"f15"});
    CHECK(ui::window::with_lead_aircraft({"f15", "500md", "f15"}, "x.obj") ==
          std::vector<std::string>{"x.obj", "500md", "x.obj"});
}
