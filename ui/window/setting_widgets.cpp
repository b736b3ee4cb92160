#include "ui/window/setting_widgets.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/setting_rows.h"
#include "ui/window/panel_widgets.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <type_traits>
#include <utility>

namespace octant::ui::window {

using settings::RunSettings;

std::vector<std::string> with_aircraft_count(std::vector<std::string> aircraft, int count) {
    const std::string first = settings::aircraft_shape(aircraft.front());
    aircraft.resize(static_cast<std::size_t>(std::max(count, 1)), first);
    return aircraft;
}

std::vector<std::string> with_lead_aircraft(std::vector<std::string> aircraft, const std::string& leader) {
    const std::string before = aircraft.front();
    std::ranges::replace(aircraft, before, leader);
    return aircraft;
}

namespace {

constexpr double three_decades = 1000.0;

bool is_wide(const settings::FieldInfo& info) {
    const double smallest = info.min_value > 0.0 ? info.min_value : 1.0;
    return info.max_value / smallest >= three_decades;
}

} // namespace

NumberStyle number_style(const settings::SettingInfo& info) {
    if (info.change >= settings::SettingsChange::World) { return NumberStyle::Typed; }
    if (info.min_value < 0.0) {
        return info.max_value - info.min_value > three_decades ? NumberStyle::Drag : NumberStyle::Slider;
    }
    return is_wide(info) ? NumberStyle::LogSlider : NumberStyle::Slider;
}

double start_value(const settings::SettingInfo& info) { return std::clamp(info.start, info.min_value, info.max_value); }

std::string_view unset_meaning(const settings::FieldInfo& info) {
    const std::size_t from = info.meaning.rfind('[');
    const std::size_t to = info.meaning.rfind(']');
    if (from == std::string_view::npos || to == std::string_view::npos || to < from) { return {}; }
    return info.meaning.substr(from + 1, to - from - 1);
}

std::string_view unset_word(const settings::FieldInfo& info) {
    const std::string_view meaning = unset_meaning(info);
    return meaning.empty() || meaning == "none" ? "none" : "auto";
}

std::string tooltip_of(const settings::FieldInfo& info) {
    std::string text = fmt::format("{}\n--{}", info.meaning, info.name);
    if (!info.form.empty()) { text += fmt::format(" {}", info.form); }
    if (info.min_value < info.max_value) { text += fmt::format(", {} to {}", info.min_value, info.max_value); }
    return text;
}

std::string comma_separated(std::span<const std::string> names) { return fmt::format("{}", fmt::join(names, ", ")); }

std::vector<std::string> split_at_commas(std::string_view text) {
    std::vector<std::string> names;
    for (const std::string_view name : split_fields(text, ',')) {
        if (!name.empty()) { names.emplace_back(name); }
    }
    return names;
}

namespace {

/// Makes a list to choose from. Returns the index of a name that was picked, if any. `chosen` is the index of the
/// current name, below zero where the list does not hold it.
std::optional<int> choose(const std::string& shown, std::span<const std::string_view> names, int chosen) {
    std::optional<int> picked;
    if (!ImGui::BeginCombo("##value", shown.c_str())) { return picked; }
    for (int i = 0; i < static_cast<int>(names.size()); ++i) {
        const std::string name(names[static_cast<std::size_t>(i)]);
        if (ImGui::Selectable(name.c_str(), i == chosen) && i != chosen) { picked = i; }
    }
    ImGui::EndCombo();
    return picked;
}

template <class Number>
bool edit_number(const settings::SettingInfo& info, Number& value) {
    constexpr bool whole = std::is_same_v<Number, int>;
    constexpr ImGuiDataType type = whole ? ImGuiDataType_S32 : ImGuiDataType_Double;
    const auto min_value = static_cast<Number>(info.min_value);
    const auto max_value = static_cast<Number>(info.max_value);
    const char* const form = whole ? "%d" : "%.6g";
    constexpr float drag_speed = 1.0F;
    Number edited = value;
    bool changed = false;
    switch (number_style(info)) {
    case NumberStyle::Typed:
        changed =
            ImGui::InputScalar("##value", type, &edited, nullptr, nullptr, form, ImGuiInputTextFlags_EnterReturnsTrue);
        break;
    case NumberStyle::Drag:
        changed = ImGui::DragScalar("##value", type, &edited, drag_speed, &min_value, &max_value, form);
        break;
    case NumberStyle::Slider:
        changed = ImGui::SliderScalar("##value", type, &edited, &min_value, &max_value, form);
        break;
    case NumberStyle::LogSlider:
        changed =
            ImGui::SliderScalar("##value", type, &edited, &min_value, &max_value, form, ImGuiSliderFlags_Logarithmic);
        break;
    }
    if (!changed || !std::isfinite(static_cast<double>(edited))) { return false; }
    value = std::clamp(edited, min_value, max_value);
    return true;
}

/// Makes a list of the only numbers that the setting takes. Returns whether another was picked.
bool choose_number(const settings::SettingInfo& info, int& value) {
    std::vector<std::string> texts;
    for (const int number : info.allowed_values) { texts.push_back(settings::text_of(number)); }
    const std::vector<std::string_view> names(texts.begin(), texts.end());
    const auto at = std::ranges::find(info.allowed_values, value) - info.allowed_values.begin();
    const auto picked = choose(settings::text_of(value), names, static_cast<int>(at));
    if (picked) { value = info.allowed_values[static_cast<std::size_t>(*picked)]; }
    return picked.has_value();
}

bool edit(const settings::SettingInfo& info, double& value) { return edit_number(info, value); }

bool edit(const settings::SettingInfo& info, int& value) {
    return info.allowed_values.empty() ? edit_number(info, value) : choose_number(info, value);
}

bool edit(const settings::SettingInfo& /*info*/, bool& value) { return ImGui::Checkbox("##value", &value); }

bool edit(const settings::SettingInfo& info, std::string& value) {
    if (!info.known.empty()) { return choose_name(info, value, info.known); }
    const auto typed = typed_text("##value", value, "");
    if (!typed || typed->empty()) { return false; }
    value = *typed;
    return true;
}

bool edit(const settings::SettingInfo& info, std::vector<std::string>& value) {
    const auto typed = typed_text("##value", comma_separated(value), info.form);
    const std::vector<std::string> names = typed ? split_at_commas(*typed) : std::vector<std::string>();
    if (names.empty()) { return false; }
    value = names;
    return true;
}

bool edit(const settings::SettingInfo& info, glm::ivec2& value) {
    std::array<int, 2> edited{value.x, value.y};
    if (!ImGui::InputInt2("##value", edited.data(), ImGuiInputTextFlags_EnterReturnsTrue)) { return false; }
    const auto bounded = [&info](int number) {
        return std::clamp(number, static_cast<int>(info.min_value), static_cast<int>(info.max_value));
    };
    value = {bounded(edited[0]), bounded(edited[1])};
    return true;
}

bool edit(const settings::SettingInfo& info, glm::dvec3& value) {
    std::array<double, 3> edited{value.x, value.y, value.z};
    constexpr float speed_m = 5.0F;
    if (!ImGui::DragScalarN(
            "##value", ImGuiDataType_Double, edited.data(), 3, speed_m, &info.min_value, &info.max_value, "%.1f")) {
        return false;
    }
    for (double& number : edited) {
        if (!std::isfinite(number)) { return false; }
        number = std::clamp(number, info.min_value, info.max_value);
    }
    value = {edited[0], edited[1], edited[2]};
    return true;
}

bool edit(const settings::SettingInfo& info, models::heights::VoidValues& voids) {
    const auto typed = typed_text("##value", settings::text_of(voids), info.form);
    try {
        models::heights::VoidValues read;
        settings::read_setting(info, typed.value_or(""), read);
        voids = read;
        return true;
    } catch (const Error&) {
        return false; // as typed in part, or nothing typed
    }
}

bool edit(const settings::SettingInfo& info, visuals::terrain::TerrainLod& lod) {
    const auto typed = typed_text("##value", settings::text_of(lod), info.form);
    try {
        if (typed) { settings::read_setting(info, *typed, lod); }
        return typed.has_value();
    } catch (const Error&) {
        return false; // typed in part
    }
}

bool edit(const settings::SettingInfo& /*info*/, glm::vec3& colour) {
    return ImGui::ColorEdit3("##value", &colour.x, ImGuiColorEditFlags_DisplayHex);
}

bool edit(const settings::SettingInfo& /*info*/, visuals::scene::Adaptation& adapt) {
    bool changed = false;
    for (const settings::AdaptationName& each : settings::adaptations) {
        if (&each != &settings::adaptations.front()) { ImGui::SameLine(); }
        changed = ImGui::Checkbox(each.name.data(), &(adapt.*each.member)) || changed;
    }
    return changed;
}

template <class Enum>
requires std::is_enum_v<Enum>

bool edit(const settings::SettingInfo& /*info*/, Enum& value) {
    const auto picked = choose(settings::text_of(value), settings::names_of<Enum>(), static_cast<int>(value));
    if (picked) { value = static_cast<Enum>(*picked); }
    return picked.has_value();
}

template <class Enum>
requires std::is_enum_v<Enum>

bool edit(const settings::SettingInfo& info, std::optional<Enum>& value) {
    std::vector<std::string_view> names{unset_word(info)};
    names.insert(names.end(), settings::names_of<Enum>().begin(), settings::names_of<Enum>().end());
    const int chosen = value ? static_cast<int>(*value) + 1 : 0;
    const auto picked = choose(std::string(names[static_cast<std::size_t>(chosen)]), names, chosen);
    if (picked && *picked == 0) {
        value.reset();
    } else if (picked) {
        value = static_cast<Enum>(*picked - 1);
    }
    return picked.has_value();
}

bool edit(const settings::SettingInfo& info, std::optional<std::string>& value) {
    const std::string hint(unset_meaning(info).empty() ? unset_word(info) : unset_meaning(info));
    const auto typed = typed_text("##value", value.value_or(""), hint);
    if (!typed) { return false; }
    value = typed->empty() ? std::nullopt : typed;
    return true;
}

template <class Value>
Value started(const settings::SettingInfo& info) {
    if constexpr (std::is_arithmetic_v<Value>) {
        return static_cast<Value>(start_value(info));
    } else {
        return Value{0.0};
    }
}

/// Makes a check mark that unsets the setting and, while it is set, the widget of its value.
template <class Value>
bool edit(const settings::SettingInfo& info, std::optional<Value>& value) {
    const float whole = ImGui::CalcItemWidth();
    const float from = ImGui::GetCursorPosX();
    bool unset = !value;
    const std::string word(unset_word(info));
    bool changed = ImGui::Checkbox(word.c_str(), &unset);
    if (changed) { value = unset ? std::nullopt : std::optional<Value>(started<Value>(info)); }
    ImGui::SameLine();
    const float left = whole - (ImGui::GetCursorPosX() - from);
    if (value) {
        ImGui::SetNextItemWidth(left);
        changed = edit(info, *value) || changed;
    } else {
        ImGui::Dummy({left, ImGui::GetFrameHeight()});
    }
    return changed;
}

/// Makes the row of a setting: the widget of its value, then its name, both with its meaning as a tooltip.
template <class Value>
void show_row(const settings::SettingInfo& info, Value& value) {
    ImGui::PushID(info.name.data(), info.name.data() + info.name.size());
    ImGui::BeginGroup();
    ImGui::SetNextItemWidth(value_width());
    ImGui::BeginDisabled(info.set_by_window);
    edit(info, value);
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::TextUnformatted(info.name.data(), info.name.data() + info.name.size());
    ImGui::EndGroup();
    if (ImGui::IsItemHovered()) { show_tooltip(tooltip_of(info)); }
    ImGui::PopID();
}

} // namespace

bool choose_name(const settings::FieldInfo& info, std::string& name, std::span<const std::string_view> names) {
    bool changed = false;
    if (!ImGui::BeginCombo("##value", name.c_str())) { return changed; }
    for (const std::string_view each : names) {
        const std::string text(each);
        if (ImGui::Selectable(text.c_str(), each == name) && each != name) {
            name = text;
            changed = true;
        }
    }
    const bool built_in = std::ranges::find(names, name) != names.end();
    ImGui::SetNextItemWidth(-1.0F);
    const auto typed = typed_text("##file", built_in ? std::string() : name, "file, then Enter");
    if (typed && !typed->empty()) {
        changed = changed || *typed != name;
        name = *typed;
        ImGui::CloseCurrentPopup();
    }
    if (ImGui::IsItemHovered()) { show_tooltip(tooltip_of(info)); }
    ImGui::EndCombo();
    return changed;
}

void edit_settings(RunSettings& settings, std::span<const std::string_view> names) {
    for (const std::string_view name : names) {
        settings::visit_settings(settings, [&](const settings::SettingInfo& info, auto& value) {
            if (info.name == name) { show_row(info, value); }
        });
    }
}

void edit_group(RunSettings& settings, settings::SettingGroup group) {
    settings::visit_settings(settings, [&](const settings::SettingInfo& info, auto& value) {
        if (info.group == group) { show_row(info, value); }
    });
}

void count_slider(std::vector<std::string>& aircraft) {
    constexpr int most = 100;
    const int count = static_cast<int>(aircraft.size());
    int& wanted_count = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("wanted count"), count);
    ImGui::SetNextItemWidth(value_width());
    ImGui::SliderInt("aircraft", &wanted_count, 1, std::max(most, count), "%d", ImGuiSliderFlags_AlwaysClamp);
    show_tooltip_on_hover("the leader and wingmen of the same kind beside it");
    if (ImGui::IsItemDeactivatedAfterEdit()) {
        aircraft = with_aircraft_count(std::move(aircraft), wanted_count);
    } else if (!ImGui::IsItemActive()) {
        wanted_count = count;
    }
}

} // namespace octant::ui::window
