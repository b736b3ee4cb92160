// What FlightGear's animations do at rest and in flight: conditions and expressions of properties, turns by time, moves
// by controls.
#include "models/meshfile/flightgear_animations.h"

#include "models/meshfile/mesh_formats.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

using Groups = std::map<std::string, ObjectNames>; ///< members by the name of their group

} // namespace

double number_in(const XmlElement& parent, std::string_view name, double without) {
    const XmlElement* found = parent.find(name);
    if (found == nullptr || found->text.empty()) { return without; }
    const auto value = finite_number(found->text);
    if (!value || std::abs(*value) > max_coordinate) { found->refuse("a number", in_quotes(found->text)); }
    return *value;
}

std::string plain_path(std::string_view path) {
    std::string plain(path.substr(std::min(path.find_first_not_of('/'), path.size())));
    for (std::size_t at = 0; (at = plain.find("[0]", at)) != plain.npos;) { plain.erase(at, 3); }
    return plain;
}

namespace {

glm::dvec3 vector_in(const XmlElement& parent, const std::array<std::string_view, 3>& names) {
    return {number_in(parent, names[0]), number_in(parent, names[1]), number_in(parent, names[2])};
}

/// The objects that an animation names; empty: all of the model.
ObjectNames objects_of(const XmlElement& animation) {
    ObjectNames names;
    for (const XmlElement& child : animation.children) {
        if (child.name == "object-name") { names.insert(child.text); }
    }
    return names;
}

/// What a table of entries makes of a value; the value itself where it has none.
double interpolated_in(const XmlElement& table, double value) {
    std::vector<std::pair<double, double>> entries;
    for (const XmlElement& entry : table.children) {
        if (entry.name == "entry") { entries.emplace_back(number_in(entry, "ind"), number_in(entry, "dep")); }
    }
    std::ranges::sort(entries);
    const auto next = std::ranges::upper_bound(entries, value, {}, [](const auto& entry) { return entry.first; });
    if (entries.empty()) { return value; }
    if (next == entries.begin() || next == entries.end()) {
        return next == entries.begin() ? next->second : entries.back().second;
    }
    const auto& [from, start] = *std::prev(next);
    return start + (value - from) / (next->first - from) * (next->second - start);
}

/// What the table of an animation makes of a property's value; the value itself without one.
double interpolated(const XmlElement& animation, double value) {
    const XmlElement* table = animation.find("interpolation");
    return table == nullptr ? value : interpolated_in(*table, value);
}

/// A point of an animation's axis and its direction, as long as the file has it: without a length where it gives none.
/// It does not turn.
RotationAxis axis_in(const XmlElement& animation) {
    RotationAxis about;
    about.direction = glm::dvec3(0.0);
    if (const XmlElement* axis = animation.find("axis")) {
        if (axis->find("x1-m") != nullptr || axis->find("x2-m") != nullptr) {
            about.point_m = vector_in(*axis, {"x1-m", "y1-m", "z1-m"});
            about.direction = vector_in(*axis, {"x2-m", "y2-m", "z2-m"}) - about.point_m;
        } else {
            about.direction = vector_in(*axis, {"x", "y", "z"});
        }
    }
    if (const XmlElement* centre = animation.find("center")) {
        about.point_m = vector_in(*centre, {"x-m", "y-m", "z-m"});
    }
    return about;
}

/// The first one that fits counts. Radians are those of surfaces that turn by 20 degrees.
constexpr std::array controlled_properties{ControlledVariable{"right-aileron-pos-norm", FlightControl::Roll, -1.0},
    ControlledVariable{"aileron-pos-norm", FlightControl::Roll, 1.0},
    ControlledVariable{"right-aileron-pos-rad", FlightControl::Roll, -0.35},
    ControlledVariable{"aileron-pos-rad", FlightControl::Roll, 0.35},
    ControlledVariable{"right-aileron-pos-deg", FlightControl::Roll, -20.0},
    ControlledVariable{"aileron-pos-deg", FlightControl::Roll, 20.0},
    ControlledVariable{"controls/flight/aileron", FlightControl::Roll, 1.0},
    ControlledVariable{"elevator-pos-norm", FlightControl::Pitch, -1.0},
    ControlledVariable{"elevator-pos-rad", FlightControl::Pitch, -0.35},
    ControlledVariable{"elevator-pos-deg", FlightControl::Pitch, -20.0},
    ControlledVariable{"controls/flight/elevator", FlightControl::Pitch, -1.0},
    ControlledVariable{"rudder-pos-norm", FlightControl::Yaw, 1.0},
    ControlledVariable{"rudder-pos-rad", FlightControl::Yaw, -0.35},
    ControlledVariable{"rudder-pos-deg", FlightControl::Yaw, -20.0},
    ControlledVariable{"controls/flight/rudder", FlightControl::Yaw, 1.0},
    ControlledVariable{"flap-pos-norm", FlightControl::Flaps, 1.0},
    ControlledVariable{"flaps-pos-norm", FlightControl::Flaps, 1.0},
    ControlledVariable{"slat-pos-norm", FlightControl::Flaps, 1.0},
    ControlledVariable{"slats-pos-norm", FlightControl::Flaps, 1.0},
    ControlledVariable{"controls/flight/flaps", FlightControl::Flaps, 1.0},
    ControlledVariable{"speedbrake-pos-norm", FlightControl::SpeedBrake, 1.0},
    ControlledVariable{"spoiler-pos-norm", FlightControl::SpeedBrake, 1.0},
    ControlledVariable{"spoilers-pos-norm", FlightControl::SpeedBrake, 1.0},
    ControlledVariable{"controls/flight/speedbrake", FlightControl::SpeedBrake, 1.0},
    ControlledVariable{"gear-pos-norm", FlightControl::Gear, 1.0},
    ControlledVariable{"controls/gear/gear-down", FlightControl::Gear, 1.0}};

/// `path`: plain.
std::optional<ControlledVariable> controlled_property(std::string_view path) {
    const bool is_gear = path.find("gear/gear") != path.npos && path.ends_with("/position-norm");
    if (is_gear) { return ControlledVariable{{}, FlightControl::Gear}; }
    const auto* const found = std::ranges::find_if(
        controlled_properties, [&](const ControlledVariable& one) { return path.ends_with(one.name); });
    return found == controlled_properties.end() ? std::nullopt : std::optional(*found);
}

struct RestingValue {
    std::string_view end_of_path;
    std::string_view value;
};

/// Seen from outside, in the air: gear and flaps up, doors and canopies shut, nothing deflected, lights off.
constexpr std::array resting_values{
    RestingValue{"current-view/view-number", "2"}, // 0 is the pilot's, in which much of the outside is hidden
    RestingValue{"current-view/internal", "0"}, RestingValue{"position-norm", "0"}, RestingValue{"wow", "0"},
    RestingValue{"crashed", "0"}, RestingValue{"sim/freeze/replay-state", "0"}};

/// What follows from the engines in level flight, where the aircraft's files state nothing else.
constexpr double cruise_throttle = 0.7;

} // namespace

void RestingProperties::take(const XmlElement& element, const std::string& path, int depth) {
    constexpr int deepest = 12;
    constexpr std::size_t most = 100'000;
    std::map<std::string, int> counts;
    for (const XmlElement& child : element.children) {
        const int number = child.number ? *child.number : counts[child.name];
        counts[child.name] = number + 1;
        const std::string name = number > 0 ? fmt::format("{}[{}]", child.name, number) : child.name;
        const std::string child_path = path.empty() ? name : fmt::format("{}/{}", path, name);
        if (child.children.empty() && values_->size() < most) { values_->try_emplace(child_path, child.text); }
        if (depth < deepest) { take(child, child_path, depth + 1); }
    }
}

RestingProperties RestingProperties::with(FlightControl control, double position) const {
    RestingProperties moved = *this;
    moved.positions_[static_cast<std::size_t>(control)] = position;
    return moved;
}

std::string RestingProperties::text(std::string_view property) const {
    const std::string path = plain_path(property);
    if (const auto controlled = controlled_property(path)) {
        return fmt::format("{}", controlled->scale * positions_[static_cast<std::size_t>(controlled->control)]);
    }
    const auto* const resting =
        std::ranges::find_if(resting_values, [&](const RestingValue& one) { return path.ends_with(one.end_of_path); });
    if (resting != resting_values.end()) { return std::string(resting->value); }
    const auto stated = values_->find(path);
    if (stated != values_->end()) { return stated->second; }
    const bool is_throttle = path.find("controls/engines/engine") != path.npos && path.ends_with("/throttle");
    return is_throttle ? fmt::format("{}", cruise_throttle) : std::string();
}

double RestingProperties::number(std::string_view property) const {
    const std::string value = text(property);
    return value == "true" ? 1.0 : finite_number(value).value_or(0.0);
}

namespace {

/// The numbers that a function of an expression takes, in their order.
using Operands = std::vector<double>;

double folded(const Operands& operands, double (*together)(double, double)) {
    double result = operands.front();
    for (std::size_t i = 1; i < operands.size(); ++i) { result = together(result, operands[i]); }
    return result;
}

/// A function of an expression by the name of its element; of as many operands as it takes.
struct ExpressionFunction {
    std::string_view name;
    double (*of)(const Operands&);
    std::size_t fewest = 1;
    std::size_t most = 1;
};

constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();
constexpr auto sum_of = [](const Operands& x) { return folded(x, [](double a, double b) { return a + b; }); };
constexpr auto difference_of = [](const Operands& x) { return folded(x, [](double a, double b) { return a - b; }); };
constexpr auto product_of = [](const Operands& x) { return folded(x, [](double a, double b) { return a * b; }); };
constexpr auto quotient_of = [](const Operands& x) { return x[0] / x[1]; };
constexpr auto modulus_of = [](const Operands& x) { return std::fmod(x[0], x[1]); };
constexpr auto magnitude_of = [](const Operands& x) { return std::abs(x[0]); };

/// As SimGear's SGReadDoubleExpression names them; angles are radians.
constexpr std::array expression_functions{ExpressionFunction{"sum", sum_of, 1, any_number},
    ExpressionFunction{"difference", difference_of, 1, any_number},
    ExpressionFunction{"dif", difference_of, 1, any_number}, ExpressionFunction{"product", product_of, 1, any_number},
    ExpressionFunction{"prod", product_of, 1, any_number}, ExpressionFunction{"div", quotient_of, 2, 2},
    ExpressionFunction{"mod", modulus_of, 2, 2}, ExpressionFunction{"abs", magnitude_of},
    ExpressionFunction{"fabs", magnitude_of},
    ExpressionFunction{"min", [](const Operands& x) { return *std::ranges::min_element(x); }, 1, any_number},
    ExpressionFunction{"max", [](const Operands& x) { return *std::ranges::max_element(x); }, 1, any_number},
    ExpressionFunction{"pow", [](const Operands& x) { return std::pow(x[0], x[1]); }, 2, 2},
    ExpressionFunction{"atan2", [](const Operands& x) { return std::atan2(x[0], x[1]); }, 2, 2},
    ExpressionFunction{"sqr", [](const Operands& x) { return x[0] * x[0]; }},
    ExpressionFunction{"sqrt", [](const Operands& x) { return std::sqrt(x[0]); }},
    ExpressionFunction{"sin", [](const Operands& x) { return std::sin(x[0]); }},
    ExpressionFunction{"cos", [](const Operands& x) { return std::cos(x[0]); }},
    ExpressionFunction{"tan", [](const Operands& x) { return std::tan(x[0]); }},
    ExpressionFunction{"asin", [](const Operands& x) { return std::asin(x[0]); }},
    ExpressionFunction{"acos", [](const Operands& x) { return std::acos(x[0]); }},
    ExpressionFunction{"atan", [](const Operands& x) { return std::atan(x[0]); }},
    ExpressionFunction{"exp", [](const Operands& x) { return std::exp(x[0]); }},
    ExpressionFunction{"log", [](const Operands& x) { return std::log(x[0]); }},
    ExpressionFunction{"log10", [](const Operands& x) { return std::log10(x[0]); }},
    ExpressionFunction{"ceil", [](const Operands& x) { return std::ceil(x[0]); }},
    ExpressionFunction{"floor", [](const Operands& x) { return std::floor(x[0]); }},
    ExpressionFunction{"deg2rad", [](const Operands& x) { return rad_from_deg(x[0]); }},
    ExpressionFunction{"rad2deg", [](const Operands& x) { return x[0] / rad_from_deg(1.0); }}};

std::optional<double> term_value(const XmlElement& term, const RestingProperties& properties);

/// The children that are terms, as numbers; nothing where one is not finite.
std::optional<Operands> operands_of(const XmlElement& function, const RestingProperties& properties) {
    Operands operands;
    for (const XmlElement& child : function.children) {
        if (child.name == "entry" || child.name == "clipMin" || child.name == "clipMax") { continue; }
        const auto value = term_value(child, properties);
        if (!value) { return std::nullopt; }
        operands.push_back(*value);
    }
    return operands;
}

/// Of a function's name. Throws Error for one that is not known.
ExpressionFunction function_of(const XmlElement& term) {
    if (term.name == "table" || term.name == "interpolate" || term.name == "clip") {
        return {term.name, nullptr, 1, any_number};
    }
    const auto* const function = std::ranges::find(expression_functions, term.name, &ExpressionFunction::name);
    if (function == expression_functions.end()) { term.refuse("a known function", in_quotes(term.name)); }
    return *function;
}

/// Nothing where the result is not finite. Throws Error as expression_value does.
std::optional<double> term_value(const XmlElement& term, const RestingProperties& properties) {
    if (term.name == "value") {
        const auto number = finite_number(term.text);
        if (!number) { term.refuse("a number", in_quotes(term.text)); }
        return number;
    }
    if (term.name == "property") { return properties.number(term.text); }
    const ExpressionFunction function = function_of(term);
    const auto operands = operands_of(term, properties);
    if (!operands) { return std::nullopt; }
    if (operands->size() < function.fewest || operands->size() > function.most) {
        const char* const counted = function.most == any_number ? " or more terms"
                                    : function.most == 1        ? " term"
                                                                : " terms";
        term.refuse(fmt::format("{}{} in {}", function.fewest, counted, term.name), std::to_string(operands->size()));
    }
    if (term.name == "table" || term.name == "interpolate") { return interpolated_in(term, operands->front()); }
    if (term.name == "clip") {
        constexpr double any = std::numeric_limits<double>::max();
        return std::min(std::max(operands->front(), number_in(term, "clipMin", -any)), number_in(term, "clipMax", any));
    }
    const double result = function.of(*operands);
    return std::isfinite(result) ? std::optional(result) : std::nullopt;
}

/// The properties below an element.
void add_properties(const XmlElement& element, std::vector<std::string>& properties) {
    for (const XmlElement& child : element.children) {
        if (child.name == "property") { properties.push_back(plain_path(child.text)); }
        add_properties(child, properties);
    }
}

} // namespace

std::optional<double> expression_value(const XmlElement& expression, const RestingProperties& properties) {
    const std::size_t terms = expression.children.size();
    if (terms != 1) { expression.refuse("1 term in an expression", std::to_string(terms)); }
    return term_value(expression.children.front(), properties);
}

namespace {

bool holds(const XmlElement& condition, const RestingProperties& properties);

bool all_hold(const XmlElement& group, const RestingProperties& properties) {
    return std::ranges::all_of(group.children, [&](const XmlElement& one) { return holds(one, properties); });
}

std::string text_of_side(const XmlElement& side, const RestingProperties& properties) {
    return side.name == "property" ? properties.text(side.text) : side.text;
}

double number_of(const XmlElement& side, const RestingProperties& properties) {
    return side.name == "expression" ? expression_value(side, properties).value_or(0.0)
           : side.name == "property" ? properties.number(side.text)
           : side.text == "true"     ? 1.0
                                     : finite_number(side.text).value_or(0.0);
}

/// Less, equal or greater, as -1, 0 or 1; as texts where a side is a text that is no number.
int order_of(const XmlElement& comparison, const RestingProperties& properties) {
    std::vector<const XmlElement*> sides;
    for (const XmlElement& side : comparison.children) {
        if (side.name == "property" || side.name == "value" || side.name == "expression") { sides.push_back(&side); }
    }
    if (sides.size() < 2) { return sides.empty() || number_of(*sides[0], properties) == 0.0 ? 0 : 1; }
    const auto is_word = [](const XmlElement& side) {
        return side.name == "value" && !side.text.empty() && side.text != "true" && side.text != "false" &&
               !finite_number(side.text);
    };
    if (is_word(*sides[0]) || is_word(*sides[1])) {
        return text_of_side(*sides[0], properties).compare(text_of_side(*sides[1], properties));
    }
    const double one = number_of(*sides[0], properties);
    const double other = number_of(*sides[1], properties);
    return one < other ? -1 : one > other ? 1 : 0;
}

bool holds(const XmlElement& condition, const RestingProperties& properties) {
    const std::string_view kind = condition.name;
    if (kind == "property") { return properties.number(condition.text) != 0.0; }
    if (kind == "not") { return !all_hold(condition, properties); }
    if (kind == "or") {
        return std::ranges::any_of(condition.children, [&](const XmlElement& one) { return holds(one, properties); });
    }
    if (kind == "and") { return all_hold(condition, properties); }
    const int order = order_of(condition, properties);
    const bool negated = kind.ends_with("not-equals");
    return (kind == "less-than" && order < 0) || (kind == "less-than-equals" && order <= 0) ||
           (kind == "greater-than" && order > 0) || (kind == "greater-than-equals" && order >= 0) ||
           (kind == "equals" && order == 0) || (negated && order != 0);
}

} // namespace

bool holds_at_rest(const XmlElement& animation, const RestingProperties& properties) {
    const XmlElement* condition = animation.find("condition");
    return condition == nullptr || all_hold(*condition, properties);
}

namespace {

/// A move of something that lies placed in another thing's axes.
PartMove placed_move(PartMove move, const AffineTransform& placement) {
    move.point_m = placement.turn * move.point_m + placement.shift_m;
    move.direction = glm::normalize(placement.turn * move.direction);
    return move;
}

} // namespace

PartMoves placed_moves(PartMoves moves, const AffineTransform& placement) {
    for (PartMove& move : moves) { move = placed_move(std::move(move), placement); }
    return moves;
}

const FlightGearRotation* FlightGearAnimations::turn_of(const std::string& object) const {
    const auto found = std::ranges::find_if(turns, [&](const FlightGearRotation& turn) {
        return object.empty() ? turn.objects.empty() : turn.objects.contains(object);
    });
    return found == turns.end() ? nullptr : &*found;
}

AffineTransform FlightGearAnimations::place_of(const std::string& object) const {
    AffineTransform place;
    for (const FlightGearRestPlacement& move : moves) {
        if (move.objects.contains(object) && turn_of(object) == nullptr) { place = place.of(move.placement); }
    }
    return place;
}

PartMoves FlightGearAnimations::moves_of(const std::string& object) const {
    PartMoves all;
    AffineTransform place;
    for (const FlightGearRestPlacement& move : moves) {
        if (!move.objects.contains(object) || turn_of(object) != nullptr) { continue; }
        if (move.move) { all.push_back(placed_move(*move.move, place)); }
        place = place.of(move.placement);
    }
    return all;
}

void FlightGearAnimations::add_outer(
    const FlightGearAnimations& outer, const AffineTransform& placement, const ObjectNames& names) {
    const auto common = [&](const ObjectNames& objects) {
        ObjectNames both;
        std::ranges::copy_if(
            objects, std::inserter(both, both.end()), [&](const std::string& name) { return names.contains(name); });
        return both;
    };
    hidden.merge(common(outer.hidden));
    for (const FlightGearRotation& turn : outer.turns) {
        if (ObjectNames objects = common(turn.objects); !objects.empty()) {
            turns.push_back(turn);
            turns.back().objects = std::move(objects);
        }
    }
    const glm::dmat3 back = glm::inverse(placement.turn);
    const AffineTransform from_outer{back, -(back * placement.shift_m)};
    std::vector<FlightGearRestPlacement> all; // what the outer model moves has been moved by this one
    for (const FlightGearRestPlacement& move : outer.moves) {
        ObjectNames objects = common(move.objects);
        if (objects.empty()) { continue; }
        all.push_back({std::move(objects), from_outer.of(move.placement).of(placement), move.move});
        if (move.move) { all.back().move = placed_move(*move.move, from_outer); }
    }
    moves.insert(moves.begin(), std::make_move_iterator(all.begin()), std::make_move_iterator(all.end()));
    for (const auto& [object, picture] : outer.pictures) {
        if (names.contains(object)) { pictures.try_emplace(object, picture); }
    }
}

namespace {

/// What a property of a kind is worth at cruise.
struct CruiseValue {
    std::string_view part_of_name;
    double value = 0.0;
};

/// Turns a minute.
constexpr double main_rotor = 390.0;
constexpr double tail_rotor = 2000.0;
constexpr double propeller = 2400.0;

/// The first one that fits counts.
constexpr std::array cruise_values{CruiseValue{"rotors/main", main_rotor}, CruiseValue{"rotors/tail", tail_rotor},
    CruiseValue{"rpm", propeller}, CruiseValue{"/n1", 90.0}, CruiseValue{"/n2", 90.0}};

/// Whether a property is one of an engine or rotor itself, not of a dial that shows it.
bool is_of_engine(std::string_view property) {
    return property.find("instrument") == property.npos &&
           (property.find("engine") != property.npos || property.find("rotor") != property.npos ||
               property.find("propeller") != property.npos);
}

double at_cruise(std::string_view property) {
    if (!is_of_engine(property)) { return 0.0; }
    const auto* const found = std::ranges::find_if(
        cruise_values, [&](const CruiseValue& one) { return property.find(one.part_of_name) != property.npos; });
    return found == cruise_values.end() ? 0.0 : found->value;
}

/// Turns a minute while the factor is 1; 0 for what does not turn in flight.
double turns_per_minute(std::string_view kind, std::string_view property) {
    const bool is_angle = property.find("position-deg") != property.npos;
    if (kind == "spin" ? is_angle : !is_angle) { return 0.0; }
    return kind == "spin" || kind == "rotate" ? at_cruise(property) : 0.0;
}

/// Turns a minute of what is called a rotor or propeller, about an axis mostly along x, y or z; 0 for what is called
/// otherwise.
double rate_by_name(const XmlElement& animation, const glm::dvec3& direction) {
    const auto named = [](const XmlElement& child) {
        const std::string name = lower_case(child.name == "object-name" ? child.text : "");
        return std::ranges::any_of(std::array{"rotor", "prop", "blade", "helice"},
            [&](const char* part) { return name.find(part) != name.npos; });
    };
    if (std::ranges::none_of(animation.children, named)) { return 0.0; }
    const glm::dvec3 along = glm::abs(direction);
    const bool upright = along.z > std::max(along.x, along.y);
    return upright ? main_rotor : along.x > along.y ? propeller : tail_rotor;
}

/// Whether a property is one of what turns on the ground or in the cockpit.
bool is_of_other_wheels(std::string_view property) {
    return std::ranges::any_of(std::array<std::string_view, 4>{"gear", "wheel", "roll", "instrument"},
        [&](std::string_view part) { return property.find(part) != property.npos; });
}

/// A blade that the property of a rotor's angle names, such as rotors/main/blade[2]/position-deg.
void take_blade(std::string_view property, double factor, FlightGearRotation& turn) {
    constexpr std::string_view name = "blade[";
    const std::size_t at = property.find(name);
    if (at == property.npos) {
        if (property.find("blade/") == property.npos) { return; }
        turn.blade = 0;
        turn.rotor = plain_path(property.substr(0, property.find("blade/")));
    } else {
        const std::string_view digits = property.substr(at + name.size());
        const auto number = whole_number(digits.substr(0, digits.find(']')));
        constexpr long most_blades = 32;
        if (!number || *number < 0 || *number >= most_blades) { return; }
        turn.blade = static_cast<int>(*number);
        turn.rotor = plain_path(property.substr(0, at));
    }
    turn.rotor += factor < 0.0 ? '-' : '+';
}

/// What an animation turns while the aircraft flies: `spin` of engines and rotors, `rotate` by a rotor's angle. They
/// turn as at cruise, since a file says by which property only: propellers at 2400 turns a minute, main rotors at 390,
/// tail rotors at 2000, turbines at 90 per cent. `spin` by a property that does not say what it is of turns what is
/// called rotor, propeller, helice or blade: about a mostly upright axis as a main rotor, along as a propeller, across
/// as a tail rotor. Nothing for wheels, instruments and all other animations. Throws Error for faulty numbers.
std::optional<FlightGearRotation> rotation_in_flight(const XmlElement& animation) {
    const std::string_view kind = animation.text_of("type");
    const std::string_view property = animation.text_of("property");
    double rate = turns_per_minute(kind, property);
    const bool by_name = rate == 0.0 && kind == "spin" && !is_of_other_wheels(property);
    if (by_name) { rate = rate_by_name(animation, glm::dvec3(0, 0, 1)); }
    if (rate == 0.0) { // then its numbers do not count: files have faulty ones
        return std::nullopt;
    }
    const double factor = number_in(animation, "factor", 1.0);
    FlightGearRotation turn{{}, axis_in(animation)};
    const double length = glm::length(turn.about.direction);
    if (factor == 0.0 || !(length > 0.0)) { return std::nullopt; }
    turn.about.direction /= length;
    if (by_name) { rate = rate_by_name(animation, turn.about.direction); }
    // An angle's factor only says which way round.
    turn.about.turns_per_s =
        kind == "spin" ? interpolated(animation, rate) * factor / 60.0 : std::copysign(rate, factor) / 60.0;
    turn.objects = objects_of(animation);
    const double first_deg = number_in(animation, kind == "spin" ? "starting-position-deg" : "offset-deg");
    turn.first_angle_rad = rad_from_deg(std::fmod(first_deg, 360.0));
    take_blade(property, factor, turn);
    return turn;
}

/// Degrees, metres or a share, for the values of properties at rest; without any for the position at the start. `unit`:
/// as its elements' names end. Nothing for an expression whose value is not finite. Throws Error for faulty numbers.
std::optional<double> value_at_rest(
    const XmlElement& animation, std::string_view unit, const RestingProperties& properties) {
    if (const XmlElement* expression = animation.find("expression")) {
        return expression_value(*expression, properties);
    }
    const auto number = [&](std::string_view name, double without) {
        return number_in(animation, std::string(name) + std::string(unit), without);
    };
    const std::string_view property = animation.text_of("property");
    const double input = property.empty() ? number("starting-position", 0.0) : properties.number(property);
    if (animation.find("interpolation") != nullptr) { return interpolated(animation, input); }
    constexpr double any = std::numeric_limits<double>::max();
    const double factor = input == 0.0 ? 1.0 : number_in(animation, "factor", 1.0);
    const double value = input * factor + number("offset", 0.0);
    return std::min(std::max(value, number("min", -any)), number("max", any));
}

} // namespace

AffineTransform turned_about(const RotationAxis& axis, double angle_rad) {
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle_rad, axis.direction));
    return {turn, axis.point_m - turn * axis.point_m};
}

namespace {

/// The controls that the value of an animation follows, each once.
std::vector<FlightControl> controls_of(const XmlElement& animation) {
    std::vector<std::string> properties{plain_path(animation.text_of("property"))};
    if (const XmlElement* expression = animation.find("expression")) {
        properties.clear();
        add_properties(*expression, properties);
    }
    std::vector<FlightControl> controls;
    for (const std::string& property : properties) {
        const auto controlled = controlled_property(property);
        if (controlled && std::ranges::find(controls, controlled->control) == controls.end()) {
            controls.push_back(controlled->control);
        }
    }
    return controls;
}

/// Where a `rotate` or `translate` animation puts things, and a further entry for each further control that moves them:
/// what several controls do adds up. None for other animations, for those that leave everything where it is, whose
/// condition does not hold at rest, or whose expression is not finite there. Throws Error for faulty numbers.
std::vector<FlightGearRestPlacement> placements_at_rest(
    const XmlElement& animation, const RestingProperties& properties) {
    const std::string_view kind = animation.text_of("type");
    const bool turns = kind == "rotate";
    if ((!turns && kind != "translate") || !holds_at_rest(animation, properties)) { return {}; }
    const std::string_view unit = turns ? "-deg" : "-m";
    const auto value = value_at_rest(animation, unit, properties);
    if (!value) { return {}; }
    std::vector<FlightGearRestPlacement> moves;
    for (const FlightControl control : controls_of(animation)) {
        auto move = sampled_move(turns ? PartMove::Kind::Turn : PartMove::Kind::Shift, control, [&](double position) {
            const double there = value_at_rest(animation, unit, properties.with(control, position)).value_or(*value);
            return turns ? rad_from_deg(there) : there;
        });
        if (move) { moves.push_back({{}, {}, std::move(move)}); }
    }
    if (moves.empty()) {
        if (*value == 0.0) { return {}; } // then its axis does not count: files have faulty ones
        moves.emplace_back();
    }
    RotationAxis axis = axis_in(animation);
    const double length = glm::length(axis.direction);
    if (!(length > 0.0)) { return {}; }
    axis.direction /= length;
    moves.front().placement =
        turns ? turned_about(axis, rad_from_deg(*value)) : AffineTransform{glm::dmat3(1.0), *value * axis.direction};
    ObjectNames objects = objects_of(animation);
    if (objects.empty()) { objects.insert(""); }
    for (FlightGearRestPlacement& one : moves) {
        if (one.move) {
            one.move->point_m = axis.point_m;
            one.move->direction = axis.direction;
        }
        one.objects = objects;
    }
    return moves;
}

/// Animations without a type give several objects one name.
Groups groups_in(const XmlElement& root) {
    Groups groups;
    for (const XmlElement& child : root.children) {
        const std::string name(child.text_of("name"));
        if (child.name == "animation" && child.text_of("type").empty() && !name.empty()) {
            groups[name].merge(objects_of(child));
            groups[name].erase("");
        }
    }
    return groups;
}

/// Adds the members of all groups that are named, and of groups among them.
void expand(ObjectNames& names, const Groups& groups) {
    for (std::size_t before = 0; before != names.size();) {
        before = names.size();
        for (const auto& [group, members] : groups) {
            if (names.contains(group)) { names.insert(members.begin(), members.end()); }
        }
    }
}

/// Sheets that FlightGear's older models move along the ground below them.
void add_shadows(const XmlElement& animation, ObjectNames& hidden) {
    std::ranges::copy_if(objects_of(animation), std::inserter(hidden, hidden.end()),
        [](const std::string& name) { return names_shadow(lower_case(name)); });
}

/// Turns of objects about the same axis become one: each costs a reading of the mesh.
void add_turn(FlightGearRotation turn, std::vector<FlightGearRotation>& turns) {
    const auto found = std::ranges::find_if(turns, [&](const FlightGearRotation& other) {
        return other.objects.empty() == turn.objects.empty() && other.first_angle_rad == turn.first_angle_rad &&
               other.blade == turn.blade && other.rotor == turn.rotor && other.about.point_m == turn.about.point_m &&
               other.about.direction == turn.about.direction && other.about.turns_per_s == turn.about.turns_per_s;
    });
    if (found != turns.end()) {
        found->objects.merge(turn.objects);
    } else {
        turns.push_back(std::move(turn));
    }
}

/// Whether an animation hides what it names from an eye outside, at rest. A blend of 0.99 and more is clear. Ranges
/// that begin within some metres hide a pilot from his own eye; those that begin at a level of detail hold coarser
/// levels, which are not needed: the finest one is refined. Throws Error for faulty numbers.
bool hides(const XmlElement& animation, const RestingProperties& properties) {
    const std::string_view kind = animation.text_of("type");
    if (kind == "light" || kind == "select") { return kind == "light" || !holds_at_rest(animation, properties); }
    constexpr double clear = 0.99;
    if (kind == "blend") {
        return holds_at_rest(animation, properties) && value_at_rest(animation, "", properties).value_or(0.0) >= clear;
    }
    constexpr double eye_outside_m = 10.0;
    return animation.find("min-property") != nullptr || number_in(animation, "min-m") > eye_outside_m;
}

/// How landing gear shows and hides what a `select` animation names; nothing for one that it does not decide, and for
/// other animations. Throws Error for faulty numbers.
std::optional<FlightGearRestPlacement> shown_by_gear(const XmlElement& animation, const RestingProperties& properties) {
    if (animation.text_of("type") != "select") { return std::nullopt; }
    FlightGearRestPlacement shown;
    const bool at_rest = holds_at_rest(animation, properties);
    bool changes = false;
    shown.move = sampled_move(PartMove::Kind::Show, FlightControl::Gear, [&](double position) {
        const bool there = holds_at_rest(animation, properties.with(FlightControl::Gear, position));
        changes = changes || there != at_rest;
        return there ? 1.0 : 0.0;
    });
    if (!changes || !shown.move) { return std::nullopt; }
    shown.objects = objects_of(animation);
    if (shown.objects.empty()) { shown.objects.insert(""); }
    return shown;
}

/// The objects that an animation names and the members of groups among them; an empty name: all of the model.
ObjectNames all_objects_of(const XmlElement& animation, const Groups& groups) {
    ObjectNames objects = objects_of(animation);
    if (objects.empty()) { objects.insert(""); }
    expand(objects, groups);
    return objects;
}

bool only_shows(std::string_view kind) {
    return kind == "range" || kind == "select" || kind == "light" || kind == "blend";
}

/// Throws Error for faulty numbers.
void add_animation(const XmlElement& animation, const RestingProperties& properties, const Groups& groups,
    FlightGearAnimations& animated) {
    const std::string kind(animation.text_of("type"));
    if (auto shown = shown_by_gear(animation, properties)) {
        expand(shown->objects, groups);
        animated.moves.push_back(std::move(*shown));
    } else if (only_shows(kind)) {
        if (hides(animation, properties)) {
            animated.hidden.merge(all_objects_of(animation, groups));
        } else if (kind == "blend") {
            ++animated.at_rest[kind];
        }
    } else if (auto turn = rotation_in_flight(animation)) {
        expand(turn->objects, groups);
        add_turn(std::move(*turn), animated.turns);
    } else if (const std::string picture(animation.text_of("texture"));
               kind == "material" && !picture.empty() && holds_at_rest(animation, properties)) {
        for (const std::string& object : all_objects_of(animation, groups)) {
            animated.pictures.insert_or_assign(object, picture);
        }
    } else {
        if (kind == "translate" || kind == "rotate") { add_shadows(animation, animated.hidden); }
        std::vector<FlightGearRestPlacement> moves = placements_at_rest(animation, properties);
        const bool is_moved = std::ranges::any_of(moves, [](const auto& one) { return one.move.has_value(); });
        if (!is_moved) { ++animated.at_rest[kind]; }
        for (FlightGearRestPlacement& move : moves) {
            expand(move.objects, groups);
            animated.moves.push_back(std::move(move));
        }
    }
}

} // namespace

FlightGearAnimations flightgear_animations(const XmlElement& root, const RestingProperties& properties) {
    const Groups groups = groups_in(root);
    FlightGearAnimations animated;
    for (const XmlElement& child : root.children) {
        const std::string kind(child.text_of("type"));
        if (child.name != "animation" || kind.empty()) { continue; }
        try {
            add_animation(child, properties, groups, animated);
        } catch (const Error& fault) {
            const bool shows = only_shows(kind);
            animated.notes.push_back(fmt::format(
                "{}; {}", fault.what(), shows ? "what it names is always shown" : "what it changes is left at rest"));
            if (!shows || kind == "blend") { ++animated.at_rest[kind]; }
        }
    }
    expand(animated.hidden, groups);
    return animated;
}

} // namespace octant::models::meshfile
