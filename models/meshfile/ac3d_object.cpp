#include "models/meshfile/ac3d_object.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace octant::models::meshfile {

namespace {

/// Whether an object's name says that it is shown in place of blades while they turn, of a lamp's
/// light, or of a shadow on the ground.
bool is_stand_in(std::string name) {
    std::ranges::transform(
        name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto has = [&](std::string_view part) { return name.find(part) != name.npos; };
    const bool of_blades = has("prop") || has("rotor") || has("blade") || has("pdis");
    const bool turns_fast = has("disc") || has("disk") || has("blur") || has("fast");
    const bool is_of_light = has("light") && (has("cone") || has("volume") || has("beam"));
    return (of_blades && turns_fast) || is_of_light || (has("shadow") && !has("noshadow"));
}

} // namespace

Ac3dObject
object_settings(const std::string& name, const Ac3dObject& holder, const ReadOptions& options) {
    Ac3dObject object = holder;
    object.is_placeholder = !holder.is_excluded && !options.placeholders && is_stand_in(name);
    object.is_excluded = holder.is_excluded || object.is_placeholder || options.excluded.contains(name);
    const auto group = std::ranges::find_if(
        options.groups, [&](const auto& names) { return names.contains(name); });
    if (holder.group == invalid_index && group != options.groups.end()) {
        object.group = static_cast<std::uint32_t>(group - options.groups.begin());
    }
    if (const auto move = options.moved.find(name); move != options.moved.end()) {
        object.moved = holder.moved.of(move->second);
    }
    return object;
}

} // namespace octant::models::meshfile
