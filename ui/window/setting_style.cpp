#include "ui/window/setting_style.h"

#include "ui/settings/settings_change.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace octant::ui::window {

namespace {

constexpr double three_decades = 1000.0;

bool is_wide(const settings::FieldInfo& info) {
    const double smallest = info.least > 0.0 ? info.least : 1.0;
    return info.most / smallest >= three_decades;
}

} // namespace

NumberStyle number_style(const settings::FieldInfo& info) {
    if (settings::change_by(info.name) == settings::SettingsChange::World) {
        return NumberStyle::Typed;
    }
    if (info.least < 0.0) {
        return info.most - info.least > three_decades ? NumberStyle::Drag : NumberStyle::Slider;
    }
    return is_wide(info) ? NumberStyle::LogSlider : NumberStyle::Slider;
}

double start_value(const settings::FieldInfo& info) {
    constexpr std::array starts{
        std::pair<std::string_view, double>{"fov", 45.0},
        std::pair<std::string_view, double>{"triangles", 20000.0},
        std::pair<std::string_view, double>{"error-px", 1.0},
        std::pair<std::string_view, double>{"roughness-c", 20.0},
        std::pair<std::string_view, double>{"frames", 600.0},
        std::pair<std::string_view, double>{"seconds", 60.0},
        std::pair<std::string_view, double>{"pictures", 60.0}};
    const auto* const found =
        std::ranges::find(starts, info.name, [](const auto& start) { return start.first; });
    return std::clamp(found == starts.end() ? 0.0 : found->second, info.least, info.most);
}

std::string_view unset_meaning(const settings::FieldInfo& info) {
    const std::size_t from = info.meaning.rfind('[');
    const std::size_t to = info.meaning.rfind(']');
    if (from == std::string_view::npos || to == std::string_view::npos || to < from) {
        return {};
    }
    return info.meaning.substr(from + 1, to - from - 1);
}

std::string_view unset_word(const settings::FieldInfo& info) {
    const std::string_view meaning = unset_meaning(info);
    return meaning.empty() || meaning == "none" ? "none" : "auto";
}

std::span<const std::string_view> known_names(std::string_view setting) {
    static constexpr std::array<std::string_view, 4> paths{"straight", "jinking", "pop-up", "turn"};
    static constexpr std::array<std::string_view, 3> aircraft{"f15", "500md", "concave"};
    static constexpr std::array<std::string_view, 4> terrains{
        "hills", "canyon", "background60", "none"};
    if (setting == "path") {
        return paths;
    }
    if (setting == "aircraft") {
        return aircraft;
    }
    if (setting == "terrain") {
        return terrains;
    }
    return {};
}

std::string tooltip_of(const settings::FieldInfo& info) {
    std::string text = fmt::format("{}\n--{}", info.meaning, info.name);
    if (!info.form.empty()) {
        text += fmt::format(" {}", info.form);
    }
    if (info.least < info.most) {
        text += fmt::format(", {} to {}", info.least, info.most);
    }
    return text;
}

std::string joined(std::span<const std::string> names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<std::string> parted(std::string_view text) {
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
