#include "ui/window/setting_widgets.h"

#include "sim/base/error.h"
#include "ui/settings/settings_fields.h"
#include "ui/window/panel_widgets.h"
#include "ui/window/setting_style.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

namespace octant::ui::window {

using settings::RunSettings;

namespace {

/// Makes the name of a setting beside the widget of its value, which is made while this object lives. Both show what
/// the setting means as a tooltip.
class Row {
public:
    explicit Row(const settings::SettingInfo& info) : info_(info) {
        ImGui::PushID(info.name.data(), info.name.data() + info.name.size());
        ImGui::BeginGroup();
        width_ = value_width();
        ImGui::SetNextItemWidth(width_);
    }

    ~Row() {
        ImGui::SameLine();
        ImGui::TextUnformatted(info_.name.data(), info_.name.data() + info_.name.size());
        ImGui::EndGroup();
        if (ImGui::IsItemHovered()) { show_tooltip(tooltip_of(info_)); }
        ImGui::PopID();
    }

    Row(const Row&) = delete;
    Row& operator=(const Row&) = delete;
    Row(Row&&) = delete;
    Row& operator=(Row&&) = delete;

    float width() const { return width_; }

private:
    const settings::SettingInfo& info_;
    float width_ = 0.0F;
};

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
    bool changed = false;
    if (!ImGui::BeginCombo("##value", settings::text_of(value).c_str())) { return changed; }
    for (const int number : info.allowed_values) {
        if (ImGui::Selectable(settings::text_of(number).c_str(), number == value) && number != value) {
            value = number;
            changed = true;
        }
    }
    ImGui::EndCombo();
    return changed;
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

struct RowOfWidgets {
    template <class Value>
    void operator()(const settings::SettingInfo& info, Value& value) const {
        const Row row(info);
        ImGui::BeginDisabled(info.set_by_window);
        edit(info, value);
        ImGui::EndDisabled();
    }
};

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
    const RowOfWidgets row;
    for (const std::string_view name : names) {
        settings::visit_settings(settings, [&](const settings::SettingInfo& info, auto& value) {
            if (info.name == name) { row(info, value); }
        });
    }
}

void edit_group(RunSettings& settings, settings::SettingGroup group) {
    const RowOfWidgets row;
    settings::visit_settings(settings, [&](const settings::SettingInfo& info, auto& value) {
        if (info.group == group) { row(info, value); }
    });
}

} // namespace octant::ui::window
