#include "ui/base/json_value.h"

#include <algorithm>
#include <cassert>

namespace octant::ui::base {

JsonValue& JsonValue::operator[](std::string_view name) {
    if (std::holds_alternative<std::monostate>(value_)) { value_ = JsonMembers(); }
    assert(std::holds_alternative<JsonMembers>(value_));
    auto& named = std::get<JsonMembers>(value_);
    const auto found = std::ranges::find(named, name, &JsonMembers::value_type::first);
    return found == named.end() ? named.emplace_back(std::string(name), JsonValue()).second : found->second;
}

void JsonValue::push_back(JsonValue member) {
    if (std::holds_alternative<std::monostate>(value_)) { value_ = List(); }
    assert(std::holds_alternative<List>(value_));
    std::get<List>(value_).push_back(std::move(member));
}

} // namespace octant::ui::base
