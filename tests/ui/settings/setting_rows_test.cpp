#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/base/data_files.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_file.h"

#include <catch2/catch.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

using namespace octant;
using ui::settings::RunSettings;
using ui::settings::SettingInfo;
using ui::settings::SettingsChange;

namespace {

// Each returns another value that the setting takes.

double other_value(const SettingInfo& info, double value) {
    return value == info.max_value ? info.min_value : info.max_value;
}

int other_value(const SettingInfo& info, int value) {
    return value == static_cast<int>(info.max_value) ? static_cast<int>(info.min_value)
                                                     : static_cast<int>(info.max_value);
}

bool other_value(const SettingInfo& /*info*/, bool value) { return !value; }

std::string other_value(const SettingInfo& /*info*/, const std::string& value) { return value + "-2"; }

std::vector<std::string> other_value(const SettingInfo&, std::vector<std::string> value) {
    value.emplace_back("wingman");
    return value;
}

glm::ivec2 other_value(const SettingInfo& /*info*/, const glm::ivec2& value) { return value + glm::ivec2(1, 2); }

glm::dvec3 other_value(const SettingInfo& /*info*/, const glm::dvec3& value) {
    return value + glm::dvec3(1.0, -2.5, 3.0);
}

models::heights::VoidValues other_value(const SettingInfo& /*info*/, const models::heights::VoidValues& voids) {
    return {{-9999.0, 0.5}, !voids.only};
}

glm::vec3 other_value(const SettingInfo& /*info*/, const glm::vec3& /*colour*/) { return {1.0F, 0.0F, 51.0F / 255.0F}; }

visuals::terrain::TerrainLod other_value(const SettingInfo& /*info*/, const visuals::terrain::TerrainLod& /*value*/) {
    return {.metric = visuals::terrain::GroundMetric::Printed,
        .fans = visuals::terrain::FanKind::Full,
        .control = visuals::terrain::DetailControl::Previous,
        .roughness_c = 7.5};
}

visuals::scene::Adaptation other_value(const SettingInfo& /*info*/, const visuals::scene::Adaptation& value) {
    return {.terrain = !value.terrain, .shading = value.shading};
}

template <class Enum>

requires std::is_enum_v<Enum>

    Enum other_value(const SettingInfo& /*info*/, Enum value) {
    const auto count = static_cast<int>(ui::settings::names_of<Enum>().size());
    return static_cast<Enum>((static_cast<int>(value) + 1) % count);
}

template <class Value>
std::optional<Value> other_value(const SettingInfo& info, const std::optional<Value>& value) {
    return other_value(info, value.value_or(Value{}));
}

std::filesystem::path written(const nlohmann::ordered_json& json) {
    const auto path = tests::scratch_folder() / "rows.json";
    write_file(path, json.dump());
    return path;
}

} // namespace

TEST_CASE("each row alone makes the file entry of its setting, and the file gives it back") {
    const auto before = ui::settings::settings_json(RunSettings());
    ui::settings::visit_rows([&](const auto& row) {
        CAPTURE(row.name);
        RunSettings changed;
        row.of(changed) = other_value(row, row.of(changed));
        const auto after = ui::settings::settings_json(changed);
        for (const auto& [key, value] : after.items()) { CHECK((value == before.at(key)) == (key != row.name)); }
        CHECK(ui::settings::read_settings(written(after)) == changed);
    });
}

TEST_CASE("each row alone says what a change of its setting makes anew") {
    ui::settings::visit_rows([](const auto& row) {
        CAPTURE(row.name);
        RunSettings changed;
        row.of(changed) = other_value(row, row.of(changed));
        CHECK(row.change != SettingsChange::None);
        CHECK(ui::settings::change_between(RunSettings(), changed) == row.change);
        CHECK(ui::settings::change_between(changed, changed) == SettingsChange::None);
    });
}

TEST_CASE("each row has a name of its own, a meaning, and limits that hold its default") {
    std::set<std::string_view> names;
    const RunSettings defaults;
    ui::settings::visit_settings(defaults, [&]<class Value>(const SettingInfo& info, const Value& value) {
        CAPTURE(info.name);
        CHECK(names.insert(info.name).second);
        CHECK(info.meaning.size() > 5);
        if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, double>) {
            CHECK(info.min_value <= value);
            CHECK(value <= info.max_value);
        }
    });
    CHECK(names.size() == ui::settings::settings_json(defaults).size());
}

TEST_CASE("settings of one group stand together, in the order of the groups") {
    std::vector<ui::settings::SettingGroup> groups;
    ui::settings::visit_rows([&](const auto& row) { groups.push_back(row.group); });
    CHECK(std::ranges::is_sorted(groups));
    CHECK(std::set(groups.begin(), groups.end()).size() == ui::settings::names_of<ui::settings::SettingGroup>().size());
}
