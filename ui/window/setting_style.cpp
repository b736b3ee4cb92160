#include "ui/window/setting_style.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace octant::ui::window {

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
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(','), text.size());
        const std::string_view field = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t from = field.find_first_not_of(' ');
        if (from != std::string_view::npos) {
            names.emplace_back(field.substr(from, field.find_last_not_of(' ') - from + 1));
        }
    }
    return names;
}

} // namespace octant::ui::window
