#include "models/meshfile/flightgear_conditions.h"

#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace octant::models::meshfile {

namespace {

bool holds(const XmlElement& condition);

bool all_hold(const XmlElement& group) {
    return std::ranges::all_of(group.children, holds);
}

double at_rest(std::string_view property) {
    constexpr double chase_view = 2.0; // 0 is the pilot's, in which much of the outside is hidden
    return property.ends_with("current-view/view-number") ? chase_view : 0.0;
}

/// What a side of a comparison is worth.
double number_of(const XmlElement& side) {
    return side.name == "property" ? at_rest(side.text) : finite_number(side.text).value_or(0.0);
}

/// Less, equal or greater, as -1, 0 or 1. Of texts only whether they are empty counts, as a
/// property at rest is.
int order_of(const XmlElement& comparison) {
    std::array<double, 2> sides{};
    std::size_t count = 0;
    for (const XmlElement& side : comparison.children) {
        const bool is_text = side.name == "value" && !finite_number(side.text);
        if (count < sides.size()) {
            sides.at(count++) = is_text && !side.text.empty() ? 1.0 : number_of(side);
        }
    }
    return sides[0] < sides[1] ? -1 : sides[0] > sides[1] ? 1 : 0;
}

bool holds(const XmlElement& condition) {
    const std::string_view kind = condition.name;
    if (kind == "property") {
        return at_rest(condition.text) != 0.0;
    }
    if (kind == "not") {
        return !all_hold(condition);
    }
    if (kind == "or") {
        return std::ranges::any_of(condition.children, holds);
    }
    if (kind == "and") {
        return all_hold(condition);
    }
    const int order = order_of(condition);
    const bool negated = kind.ends_with("not-equals");
    return (kind == "less-than" && order < 0) || (kind == "less-than-equals" && order <= 0) ||
           (kind == "greater-than" && order > 0) || (kind == "greater-than-equals" && order >= 0) ||
           (kind == "equals" && order == 0) || (negated && order != 0);
}

} // namespace

bool holds_at_rest(const XmlElement& animation) {
    const XmlElement* condition = animation.find("condition");
    return condition == nullptr || all_hold(*condition);
}

} // namespace octant::models::meshfile
