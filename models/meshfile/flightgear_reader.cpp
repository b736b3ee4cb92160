// FlightGear's model files: a PropertyList that names a mesh, other models with their offsets, and animations, which
// are read as at rest (RestingProperties), but for what turns in flight. Its axes are x back, y right, z up; AC3D files
// lie in them as (x, -z, y).
#include "models/meshfile/flightgear_xml.h"
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_join.h"
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
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;
using Groups = std::map<std::string, Names>; ///< members by the name of their group

constexpr int max_include_depth = 8;
constexpr int max_files = 500;

XmlElement with_includes(const fs::path& file, int depth, int& files);

void include_into(XmlElement& element, int depth, int& files) {
    const fs::path included = element.include.empty() ? fs::path() : flightgear_file(*element.file, element.include);
    if (included.empty()) { return; }
    if (depth == max_include_depth) { element.refuse(fmt::format("includes at most {} deep", depth), "more"); }
    if (++files > max_files) { element.refuse(fmt::format("at most {} includes", max_files), "more"); }
    XmlElement other = with_includes(included, depth + 1, files);
    element.children.insert(element.children.end(), std::make_move_iterator(other.children.begin()),
        std::make_move_iterator(other.children.end()));
}

XmlElement with_includes(const fs::path& file, int depth, int& files) {
    XmlElement root = read_xml(file);
    for (XmlElement& child : root.children) { include_into(child, depth, files); }
    include_into(root, depth, files);
    return root;
}

/// Reads a FlightGear file. Elements that the outermost element or one of its children includes from another file are
/// appended to its own; an included file that does not exist is skipped. Throws Error for files that cannot be read,
/// and for includes more than 8 deep or 500 in all.
XmlElement flightgear_tree(const fs::path& file) {
    int files = 0;
    return with_includes(file, 0, files);
}

/// The number in a child of an element of a FlightGear file; `without` where there is none. Throws Error for what is no
/// number, or beyond max_coordinate.
double number_in(const XmlElement& parent, std::string_view name, double without = 0.0) {
    const XmlElement* found = parent.find(name);
    if (found == nullptr || found->text.empty()) { return without; }
    const auto value = finite_number(found->text);
    if (!value || std::abs(*value) > max_coordinate) { found->refuse("a number", in_quotes(found->text)); }
    return *value;
}

glm::dvec3 vector_in(const XmlElement& parent, const std::array<std::string_view, 3>& names) {
    return {number_in(parent, names[0]), number_in(parent, names[1]), number_in(parent, names[2])};
}

/// The objects that an animation names; empty: all of the model.
Names objects_of(const XmlElement& animation) {
    Names names;
    for (const XmlElement& child : animation.children) {
        if (child.name == "object-name") { names.insert(child.text); }
    }
    return names;
}

/// What the table of an animation makes of a property's value; the value itself without one.
double interpolated(const XmlElement& animation, double value) {
    const XmlElement* table = animation.find("interpolation");
    std::vector<std::pair<double, double>> entries;
    for (std::size_t i = 0; table != nullptr && i < table->children.size(); ++i) {
        const XmlElement& entry = table->children[i];
        entries.emplace_back(number_in(entry, "ind"), number_in(entry, "dep"));
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

/// A property's path without a slash in front and without indices of 0.
std::string plain_path(std::string_view path) {
    std::string plain(path.substr(std::min(path.find_first_not_of('/'), path.size())));
    for (std::size_t at = 0; (at = plain.find("[0]", at)) != plain.npos;) { plain.erase(at, 3); }
    return plain;
}

/// A property that follows a control: its value is `scale` times the control's position.
struct ControlledProperty {
    std::string_view end_of_path;
    FlightControl control = FlightControl::Roll;
    double scale = 1.0;
};

/// The first one that fits counts. Radians are those of surfaces that turn by 20 degrees.
constexpr std::array controlled_properties{ControlledProperty{"right-aileron-pos-norm", FlightControl::Roll, -1.0},
    ControlledProperty{"aileron-pos-norm", FlightControl::Roll, 1.0},
    ControlledProperty{"right-aileron-pos-rad", FlightControl::Roll, -0.35},
    ControlledProperty{"aileron-pos-rad", FlightControl::Roll, 0.35},
    ControlledProperty{"right-aileron-pos-deg", FlightControl::Roll, -20.0},
    ControlledProperty{"aileron-pos-deg", FlightControl::Roll, 20.0},
    ControlledProperty{"controls/flight/aileron", FlightControl::Roll, 1.0},
    ControlledProperty{"elevator-pos-norm", FlightControl::Pitch, -1.0},
    ControlledProperty{"elevator-pos-rad", FlightControl::Pitch, -0.35},
    ControlledProperty{"elevator-pos-deg", FlightControl::Pitch, -20.0},
    ControlledProperty{"controls/flight/elevator", FlightControl::Pitch, -1.0},
    ControlledProperty{"rudder-pos-norm", FlightControl::Yaw, 1.0},
    ControlledProperty{"rudder-pos-rad", FlightControl::Yaw, -0.35},
    ControlledProperty{"rudder-pos-deg", FlightControl::Yaw, -20.0},
    ControlledProperty{"controls/flight/rudder", FlightControl::Yaw, 1.0},
    ControlledProperty{"flap-pos-norm", FlightControl::Flaps, 1.0},
    ControlledProperty{"flaps-pos-norm", FlightControl::Flaps, 1.0},
    ControlledProperty{"slat-pos-norm", FlightControl::Flaps, 1.0},
    ControlledProperty{"slats-pos-norm", FlightControl::Flaps, 1.0},
    ControlledProperty{"controls/flight/flaps", FlightControl::Flaps, 1.0},
    ControlledProperty{"speedbrake-pos-norm", FlightControl::SpeedBrake, 1.0},
    ControlledProperty{"spoiler-pos-norm", FlightControl::SpeedBrake, 1.0},
    ControlledProperty{"spoilers-pos-norm", FlightControl::SpeedBrake, 1.0},
    ControlledProperty{"controls/flight/speedbrake", FlightControl::SpeedBrake, 1.0},
    ControlledProperty{"gear-pos-norm", FlightControl::Gear, 1.0},
    ControlledProperty{"controls/gear/gear-down", FlightControl::Gear, 1.0}};

/// `path`: plain.
std::optional<ControlledProperty> controlled_property(std::string_view path) {
    const bool is_gear = path.find("gear/gear") != path.npos && path.ends_with("/position-norm");
    if (is_gear) { return ControlledProperty{{}, FlightControl::Gear, 1.0}; }
    const auto* const found = std::ranges::find_if(
        controlled_properties, [&](const ControlledProperty& one) { return path.ends_with(one.end_of_path); });
    return found == controlled_properties.end() ? std::nullopt : std::optional(*found);
}

/// What properties are worth at rest: what an aircraft's -set.xml states, then a table, else nothing, which is 0 or an
/// empty text.
class RestingProperties {
public:
    /// Takes the values below an element of a -set.xml, whose path is `path`.
    void take(const XmlElement& element, const std::string& path, int depth = 0) {
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

    /// The same with a control at a position; shares what the aircraft states.
    RestingProperties with(FlightControl control, double position) const {
        RestingProperties moved = *this;
        moved.positions_[static_cast<std::size_t>(control)] = position;
        return moved;
    }

    std::string text(std::string_view property) const {
        const std::string path = plain_path(property);
        if (const auto controlled = controlled_property(path)) {
            return fmt::format("{}", controlled->scale * positions_[static_cast<std::size_t>(controlled->control)]);
        }
        const auto* const resting = std::ranges::find_if(
            resting_values, [&](const RestingValue& one) { return path.ends_with(one.end_of_path); });
        if (resting != resting_values.end()) { return std::string(resting->value); }
        const auto stated = values_->find(path);
        return stated == values_->end() ? std::string() : stated->second;
    }

    double number(std::string_view property) const {
        const std::string value = text(property);
        return value == "true" ? 1.0 : finite_number(value).value_or(0.0);
    }

private:
    struct RestingValue {
        std::string_view end_of_path;
        std::string_view value;
    };

    /// Seen from outside, in the air: gear and flaps up, doors and canopies shut, nothing deflected, lights off.
    static constexpr std::array resting_values{
        RestingValue{"current-view/view-number", "2"}, // 0 is the pilot's, in which much of the outside is hidden
        RestingValue{"current-view/internal", "0"}, RestingValue{"position-norm", "0"}, RestingValue{"wow", "0"},
        RestingValue{"crashed", "0"}, RestingValue{"sim/freeze/replay-state", "0"}};

    /// By plain paths.
    std::shared_ptr<std::map<std::string, std::string>> values_ =
        std::make_shared<std::map<std::string, std::string>>();
    ControlPositions positions_{};
};

bool holds(const XmlElement& condition, const RestingProperties& properties);

bool all_hold(const XmlElement& group, const RestingProperties& properties) {
    return std::ranges::all_of(group.children, [&](const XmlElement& one) { return holds(one, properties); });
}

std::string text_of_side(const XmlElement& side, const RestingProperties& properties) {
    return side.name == "property" ? properties.text(side.text) : side.text;
}

double number_of(const XmlElement& side, const RestingProperties& properties) {
    return side.name == "property" ? properties.number(side.text)
           : side.text == "true"   ? 1.0
                                   : finite_number(side.text).value_or(0.0);
}

/// Less, equal or greater, as -1, 0 or 1; as texts where a side is a text that is no number.
int order_of(const XmlElement& comparison, const RestingProperties& properties) {
    std::vector<const XmlElement*> sides;
    for (const XmlElement& side : comparison.children) {
        if (side.name == "property" || side.name == "value") { sides.push_back(&side); }
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

/// Whether the <condition> of a FlightGear animation holds at rest. True without a condition.
bool holds_at_rest(const XmlElement& animation, const RestingProperties& properties) {
    const XmlElement* condition = animation.find("condition");
    return condition == nullptr || all_hold(*condition, properties);
}

/// An animation by which something turns in flight; axes of the FlightGear model.
struct FlightGearRotation {
    Names objects; ///< by name; empty: all of the model
    RotationAxis about;
    double first_angle_rad = 0.0; ///< at which it stands at time 0
    /// Of one blade: its number, and what its rotor is called; the blades stand evenly around the axis.
    std::optional<int> blade = {};
    std::string rotor = {};
};

/// Where a `rotate` or `translate` animation puts what it names at rest, landing gear up, for one, and how a control
/// moves it from there, or shows and hides it. Axes of the FlightGear model.
struct FlightGearRestPlacement {
    Names objects; ///< by name; an empty one: all of the model
    AffineTransform placement;
    std::optional<PartMove> move = {};
};

/// A move of something that lies placed in another thing's axes.
PartMove placed_move(PartMove move, const AffineTransform& placement) {
    move.point_m = placement.turn * move.point_m + placement.shift_m;
    move.direction = glm::normalize(placement.turn * move.direction);
    return move;
}

PartMoves placed_moves(PartMoves moves, const AffineTransform& placement) {
    for (PartMove& move : moves) { move = placed_move(std::move(move), placement); }
    return moves;
}

/// What the animations of one FlightGear model do to the objects of its mesh and to its sub-models, by their names;
/// axes of that model.
struct FlightGearAnimations {
    /// What a range shows only to eyes farther than some metres away, what a select hides at rest, what stands for a
    /// light's reach, and what is moved along the ground as a shadow. An empty name stands for all of the model.
    Names hidden;
    std::vector<FlightGearRotation> turns;      ///< of objects about the same axis only one
    std::vector<FlightGearRestPlacement> moves; ///< in the file's order: the first one moves what others moved
    std::map<std::string, int> at_rest;         ///< how many others there are, by their types
    /// Pictures that a `material` animation puts on objects while its properties are not set; "" = on all others.
    std::map<std::string, std::string> pictures;
    std::vector<std::string> notes; ///< faults in them; often none

    /// What turns an object; the empty name stands for all of the model. Null for what stays.
    const FlightGearRotation* turn_of(const std::string& object) const {
        const auto found = std::ranges::find_if(turns, [&](const FlightGearRotation& turn) {
            return object.empty() ? turn.objects.empty() : turn.objects.contains(object);
        });
        return found == turns.end() ? nullptr : &*found;
    }

    /// Where an object stands at rest; the empty name stands for all of the model. What turns in flight is not moved:
    /// its axis stands where the file has it.
    AffineTransform place_of(const std::string& object) const {
        AffineTransform place;
        for (const FlightGearRestPlacement& move : moves) {
            if (move.objects.contains(object) && turn_of(object) == nullptr) { place = place.of(move.placement); }
        }
        return place;
    }

    /// How controls move an object from there; the empty name stands for all of the model.
    PartMoves moves_of(const std::string& object) const {
        PartMoves all;
        AffineTransform place;
        for (const FlightGearRestPlacement& move : moves) {
            if (!move.objects.contains(object) || turn_of(object) != nullptr) { continue; }
            if (move.move) { all.push_back(placed_move(*move.move, place)); }
            place = place.of(move.placement);
        }
        return all;
    }
};

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

/// Degrees or metres, for the property's value at rest; without one for the position at the start. `unit`: as its
/// elements' names end.
double value_at_rest(const XmlElement& animation, std::string_view unit, const RestingProperties& properties) {
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

AffineTransform turned_about(const RotationAxis& axis, double angle_rad) {
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle_rad, axis.direction));
    return {turn, axis.point_m - turn * axis.point_m};
}

/// Nothing for other animations, for those that leave everything where it is, whose condition does not hold at rest, or
/// that compute an <expression>. Throws Error for faulty numbers.
std::optional<FlightGearRestPlacement> placement_at_rest(
    const XmlElement& animation, const RestingProperties& properties) {
    const std::string_view kind = animation.text_of("type");
    const bool turns = kind == "rotate";
    if ((!turns && kind != "translate") || animation.find("expression") != nullptr ||
        !holds_at_rest(animation, properties)) {
        return std::nullopt;
    }
    const std::string_view unit = turns ? "-deg" : "-m";
    const double value = value_at_rest(animation, unit, properties);
    FlightGearRestPlacement move;
    if (const auto controlled = controlled_property(plain_path(animation.text_of("property")))) {
        move.move = sampled_move(
            turns ? PartMove::Kind::Turn : PartMove::Kind::Shift, controlled->control, [&](double position) {
                const double there = value_at_rest(animation, unit, properties.with(controlled->control, position));
                return turns ? rad_from_deg(there) : there;
            });
    }
    if (value == 0.0 && !move.move) { // then its axis does not count: files have faulty ones
        return std::nullopt;
    }
    RotationAxis axis = axis_in(animation);
    const double length = glm::length(axis.direction);
    if (!(length > 0.0)) { return std::nullopt; }
    axis.direction /= length;
    if (move.move) {
        move.move->point_m = axis.point_m;
        move.move->direction = axis.direction;
    }
    move.placement =
        turns ? turned_about(axis, rad_from_deg(value)) : AffineTransform{glm::dmat3(1.0), value * axis.direction};
    move.objects = objects_of(animation);
    if (move.objects.empty()) { move.objects.insert(""); }
    return move;
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
void expand(Names& names, const Groups& groups) {
    for (std::size_t before = 0; before != names.size();) {
        before = names.size();
        for (const auto& [group, members] : groups) {
            if (names.contains(group)) { names.insert(members.begin(), members.end()); }
        }
    }
}

/// Sheets that FlightGear's older models move along the ground below them.
void add_shadows(const XmlElement& animation, Names& hidden) {
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

/// What `read(animation)` gives; nothing for one whose numbers are faulty.
template <typename Read>
auto unless_faulty(const Read& read, const XmlElement& animation, std::vector<std::string>& notes)
    -> decltype(read(animation)) {
    try {
        return read(animation);
    } catch (const Error& fault) {
        notes.push_back(fmt::format("{}; what it moves is left at rest", fault.what()));
        return std::nullopt;
    }
}

/// Whether an animation hides what it names from an eye outside, at rest. Ranges that begin within some metres hide a
/// pilot from his own eye; those that begin at a level of detail hold coarser levels, which are not needed: the finest
/// one is refined. One whose numbers are faulty hides nothing.
bool hides(const XmlElement& animation, const RestingProperties& properties, std::vector<std::string>& notes) {
    const std::string_view kind = animation.text_of("type");
    if (kind != "range") { return kind == "light" || !holds_at_rest(animation, properties); }
    try {
        constexpr double eye_outside_m = 10.0;
        return animation.find("min-property") != nullptr || number_in(animation, "min-m") > eye_outside_m;
    } catch (const Error& fault) {
        notes.push_back(fmt::format("{}; what it names is always shown", fault.what()));
        return false;
    }
}

/// How landing gear shows and hides what a `select` animation names; nothing for one that it does not decide, and for
/// other animations.
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

/// `root`: of flightgear_tree(file).
FlightGearAnimations flightgear_animations(const XmlElement& root, const RestingProperties& properties) {
    const Groups groups = groups_in(root);
    FlightGearAnimations animated;
    for (const XmlElement& child : root.children) {
        const std::string kind(child.text_of("type"));
        if (child.name != "animation" || kind.empty()) { continue; }
        if (auto shown = shown_by_gear(child, properties)) {
            expand(shown->objects, groups);
            animated.moves.push_back(std::move(*shown));
        } else if (kind == "range" || kind == "select" || kind == "light") {
            if (hides(child, properties, animated.notes)) {
                Names objects = objects_of(child);
                if (objects.empty()) { objects.insert(""); }
                animated.hidden.merge(objects);
            }
        } else if (auto turn = unless_faulty(rotation_in_flight, child, animated.notes)) {
            expand(turn->objects, groups);
            add_turn(std::move(*turn), animated.turns);
        } else if (const std::string picture(child.text_of("texture"));
                   kind == "material" && !picture.empty() && holds_at_rest(child, properties)) {
            Names objects = objects_of(child);
            if (objects.empty()) { objects.insert(""); }
            expand(objects, groups);
            for (const std::string& object : objects) { animated.pictures.insert_or_assign(object, picture); }
        } else {
            if (kind == "translate" || kind == "rotate") { add_shadows(child, animated.hidden); }
            const auto rest = [&](const XmlElement& animation) { return placement_at_rest(animation, properties); };
            auto move = unless_faulty(rest, child, animated.notes);
            if (!move || !move->move) { ++animated.at_rest[kind]; }
            if (move) {
                expand(move->objects, groups);
                animated.moves.push_back(std::move(*move));
            }
        }
    }
    expand(animated.hidden, groups);
    return animated;
}

constexpr int max_model_depth = 8;
constexpr std::size_t max_models = 500;
constexpr std::size_t max_notes = 20;

/// Columns: where x, y and z of AC3D files point in a model.
const glm::dmat3 from_ac3d(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0));

glm::dmat3 turn_about(int axis, double angle_rad) {
    glm::dmat3 turn(1.0);
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    turn[next][next] = turn[last][last] = std::cos(angle_rad);
    turn[next][last] = std::sin(angle_rad);
    turn[last][next] = -std::sin(angle_rad);
    return turn;
}

class FlightGearReading {
public:
    FlightGearReading(const fs::path& path, const ReadOptions& options) : path_(path), options_(options) {}

    RotatingModel read() {
        take_model(model_file(), {}, 0);
        join_turning();
        if (model_.body.triangles.empty()) { // all of it moves: then none of it does
            const std::vector<RotatingPart> parts = std::exchange(model_.parts, {});
            const TriangleMesh clear = std::exchange(model_.clear, {});
            model_.body = mesh_at_rest({std::move(model_.body), parts, clear});
        }
        if (model_.body.triangles.empty()) { throw_error_in(path_, "expected a model with a mesh, got none"); }
        if (const std::size_t all = model_.body.notes.size(); all > max_notes) {
            model_.body.notes.resize(max_notes);
            model_.body.notes.push_back(
                fmt::format("{}: {} more notes on its sub-models", path_.string(), all - max_notes));
        }
        model_.body.name = path_.stem().string();
        if (!at_rest_.empty()) {
            std::string kinds;
            for (const auto& [kind, count] : at_rest_) {
                kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, printable(kind));
            }
            model_.body.notes.push_back(fmt::format("{}: animations are left at rest: {}", path_.string(), kinds));
        }
        return std::move(model_);
    }

private:
    /// An aircraft's own file, such as b25-set.xml, names its model among much else.
    fs::path model_file() {
        if (!path_.filename().string().ends_with("-set.xml")) { return path_; }
        const XmlElement root = flightgear_tree(path_);
        properties_.take(root, "");
        for (const XmlElement& sim : root.children) {
            const XmlElement* model = sim.name == "sim" ? sim.find("model") : nullptr;
            const std::string name(model == nullptr ? "" : model->text_of("path"));
            if (name.empty()) { continue; }
            fs::path file = flightgear_file(path_, name);
            if (file.empty()) {
                throw_error_in(path_, "expected a file of its sim/model/path, got none called " + in_quotes(name));
            }
            return file;
        }
        throw_error_in(path_, "expected a model's path in sim/model, got none");
    }

    AffineTransform offsets(const XmlElement& parent) const {
        const XmlElement* found = parent.find("offsets");
        if (found == nullptr) { return {}; }
        const auto angle_rad = [&](std::string_view name) { return rad_from_deg(number_in(*found, name)); };
        const glm::dmat3 turn = turn_about(2, angle_rad("heading-deg")) * turn_about(1, angle_rad("pitch-deg")) *
                                turn_about(0, angle_rad("roll-deg"));
        return {turn, {number_in(*found, "x-m"), number_in(*found, "y-m"), number_in(*found, "z-m")}};
    }

    /// What a model inherits from those that hold it.
    struct Inherited {
        AffineTransform placement;
        const FlightGearRotation* about = nullptr; ///< what turns all of it; null for what does not turn as a whole
        PartMoves moves;                           ///< axes of the whole
    };

    void take_model(const fs::path& file, const Inherited& parent, int depth) {
        if (extension_of(file) != ".xml") {
            add_mesh(file, parent, {});
            return;
        }
        if (depth > max_model_depth || ++models_ > max_models) {
            throw_error_in(file, fmt::format("expected models at most {} deep, got more", max_model_depth));
        }
        const XmlElement root = flightgear_tree(file);
        Inherited own = parent;
        own.placement = parent.placement.of(offsets(root));
        const FlightGearAnimations animated = animations_of(root, own);
        if (animated.hidden.contains("") && depth > 0) { return; }
        if (own.about == nullptr) { own.about = animated.turn_of(""); }
        options_.pictures_in = flightgear_pictures(file, std::string(root.text_of("texture-path")));
        if (const std::string name(root.text_of("path")); !name.empty()) {
            if (depth == 0 && flightgear_file(file, name).empty()) {
                throw_error_in(file, "expected a file of its path, got none called " + in_quotes(name));
            }
            for (const auto& [object, picture] : animated.pictures) {
                const fs::path found = picture_file(file, picture, file.parent_path());
                if (std::error_code ignored; fs::is_regular_file(found, ignored)) {
                    options_.repainted[object] = fs::absolute(found).string();
                }
            }
            take_named(file, name, own, animated, depth);
        }
        options_.repainted.clear();
        options_.pictures_in.clear();
        for (const XmlElement& child : root.children) {
            const std::string path(child.text_of("path"));
            const std::string name(child.text_of("name"));
            const bool is_hidden = !name.empty() && animated.hidden.contains(name);
            if (child.name == "model" && !path.empty() && !is_hidden && holds_at_rest(child, properties_)) {
                Inherited moved = own;
                if (!name.empty()) {
                    if (own.about == nullptr) { moved.about = animated.turn_of(name); }
                    add_moves(placed_moves(animated.moves_of(name), own.placement), moved.moves);
                    moved.placement = own.placement.of(animated.place_of(name));
                }
                moved.placement = moved.placement.of(offsets(child));
                take_named(file, path, moved, {}, depth);
            }
        }
    }

    static void add_moves(PartMoves inner, PartMoves& moves) {
        moves.insert(moves.end(), std::make_move_iterator(inner.begin()), std::make_move_iterator(inner.end()));
    }

    /// Also moves `own`, the model, to where it stands at rest, and adds what moves all of it.
    FlightGearAnimations animations_of(const XmlElement& root, Inherited& own) {
        FlightGearAnimations animated = flightgear_animations(root, properties_);
        add_moves(placed_moves(animated.moves_of(""), own.placement), own.moves);
        own.placement = own.placement.of(animated.place_of(""));
        for (FlightGearRotation& turn : animated.turns) {
            turn.about.point_m = own.placement.turn * turn.about.point_m + own.placement.shift_m;
            turn.about.direction = own.placement.turn * turn.about.direction;
        }
        for (const auto& [kind, count] : animated.at_rest) { at_rest_[kind] += count; }
        std::ranges::for_each(animated.notes, [&](const std::string& note) { note_once(note); });
        return animated;
    }

    void take_named(const fs::path& from, const std::string& name, const Inherited& inherited,
        const FlightGearAnimations& animated, int depth) {
        const fs::path file = flightgear_file(from, name);
        if (file.empty()) {
            note_once(fmt::format("{}: no file of path '{}'", from.string(), printable(name)));
        } else if (extension_of(file) == ".xml") {
            take_sub_model(file, inherited, depth + 1);
        } else if (is_mesh_file(file)) {
            add_mesh(file, inherited, animated);
        } else {
            note_once(file.string() + ": sub-models of this kind are left out");
        }
    }

    /// A faulty file below the first one costs itself alone.
    void take_sub_model(const fs::path& file, const Inherited& inherited, int depth) {
        try {
            take_model(file, inherited, depth);
        } catch (const Error& fault) { note_once(fmt::format("{}; what else is in there is left out", fault.what())); }
    }

    /// Objects that the same moves move, in axes of the whole.
    struct MovedObjects {
        Names objects;
        PartMoves moves;
    };

    static std::vector<MovedObjects> moved_objects(const FlightGearAnimations& animated, const Inherited& inherited) {
        std::vector<MovedObjects> moved;
        Names named;
        for (const FlightGearRestPlacement& move : animated.moves) {
            if (move.move) { named.insert(move.objects.begin(), move.objects.end()); }
        }
        named.erase("");
        for (const std::string& object : named) {
            PartMoves moves = inherited.moves;
            add_moves(placed_moves(animated.moves_of(object), inherited.placement), moves);
            if (moves.size() == inherited.moves.size()) { continue; }
            const auto known = std::ranges::find(moved, moves, &MovedObjects::moves);
            MovedObjects& group = known != moved.end() ? *known : moved.emplace_back(MovedObjects{{}, moves});
            group.objects.insert(object);
        }
        return moved;
    }

    void add_mesh(const fs::path& file, const Inherited& inherited, const FlightGearAnimations& animated) {
        const FlightGearRotation* about = inherited.about;
        if (!animated.turns.empty() && extension_of(file) != ".ac") {
            note_once(file.string() + ": its objects are not told apart, so none of them turns");
        }
        ReadOptions options = options_;
        options.excluded = animated.hidden;
        for (const FlightGearRestPlacement& move : animated.moves) {
            for (const std::string& object : move.objects) {
                options.moved[object] = in_ac3d(animated.place_of(object));
            }
        }
        std::vector<MovedObjects> moved;
        if (about == nullptr) {
            for (const FlightGearRotation& turn : animated.turns) { options.groups.push_back(turn.objects); }
            moved = moved_objects(animated, inherited);
            for (const MovedObjects& group : moved) { options.groups.push_back(group.objects); }
        }
        try {
            MeshParts parts = read_parts(file, options);
            const AffineTransform placed = in_model(file, inherited.placement);
            const bool moves = about != nullptr || !inherited.moves.empty();
            join_mesh(moves ? moving_mesh(about, inherited.moves) : model_.body, std::move(parts.body), placed);
            for (std::size_t i = 0; i < parts.groups.size(); ++i) {
                if (parts.groups[i].triangles.empty()) { continue; }
                const bool turns = i < animated.turns.size();
                join_mesh(turns ? moving_mesh(&animated.turns[i], inherited.moves)
                                : moving_mesh(nullptr, moved[i - animated.turns.size()].moves),
                    std::move(parts.groups[i]), placed);
            }
            join_mesh(model_.clear, std::move(parts.clear), placed);
        } catch (const Error& fault) { note_once(fmt::format("{}; this sub-model is left out", fault.what())); }
    }

    /// A move within a model, within an AC3D file.
    static AffineTransform in_ac3d(const AffineTransform& in_model) {
        return {glm::transpose(from_ac3d) * in_model.turn * from_ac3d, glm::transpose(from_ac3d) * in_model.shift_m};
    }

    static AffineTransform in_model(const fs::path& file, const AffineTransform& placement) {
        return placement.of({extension_of(file) == ".ac" ? from_ac3d : glm::dmat3(1.0)});
    }

    /// What turns and moves in one way, as it stands in its file and at rest.
    struct TurningMesh {
        FlightGearRotation turn;
        PartMoves moves;
        TriangleMesh mesh;
    };

    /// `about`: null for what does not turn by time.
    TriangleMesh& moving_mesh(const FlightGearRotation* about, const PartMoves& moves) {
        const FlightGearRotation turn = about == nullptr ? FlightGearRotation{} : *about;
        const auto known = std::ranges::find_if(turning_, [&](const TurningMesh& one) {
            return one.turn.about.point_m == turn.about.point_m && one.turn.about.direction == turn.about.direction &&
                   one.turn.about.turns_per_s == turn.about.turns_per_s && one.turn.blade == turn.blade &&
                   one.turn.rotor == turn.rotor && one.turn.first_angle_rad == turn.first_angle_rad &&
                   one.moves == moves;
        });
        return known != turning_.end() ? known->mesh : turning_.emplace_back(TurningMesh{turn, moves, {}}).mesh;
    }

    /// Turns blades to where they stand at time 0, evenly around their rotor's axis.
    void join_turning() {
        std::map<std::string, int> blades;
        for (const TurningMesh& one : turning_) {
            int& count = blades[one.turn.rotor];
            count = std::max(count, one.turn.blade.value_or(0) + 1);
        }
        for (TurningMesh& one : turning_) {
            const bool is_backward = one.turn.rotor.ends_with('-');
            const double share = static_cast<double>(one.turn.blade.value_or(0)) / blades[one.turn.rotor];
            const double angle_rad =
                one.turn.first_angle_rad + (is_backward ? -1.0 : 1.0) * share * rad_from_deg(360.0);
            const AffineTransform turned =
                angle_rad == 0.0 ? AffineTransform() : turned_about(one.turn.about, angle_rad);
            if (!one.mesh.triangles.empty()) {
                join_mesh(part_about(one.turn.about, one.moves), std::move(one.mesh), turned);
            }
        }
        turning_.clear();
    }

    /// The mesh of what turns about an axis: of several blades it is the same.
    TriangleMesh& part_about(const RotationAxis& about, const PartMoves& moves) {
        constexpr double near_m = 0.01;
        for (RotatingPart& part : model_.parts) {
            const glm::dvec3 across_m = glm::cross(part.about.direction, about.point_m - part.about.point_m);
            if (glm::dot(part.about.direction, about.direction) > 1.0 - 1e-6 && glm::length(across_m) < near_m &&
                std::abs(part.about.turns_per_s - about.turns_per_s) < 1e-9 && part.moves == moves) {
                return part.mesh;
            }
        }
        return model_.parts.emplace_back(RotatingPart{{}, about, moves}).mesh;
    }

    void note_once(const std::string& note) {
        if (told_.insert(note).second) { model_.body.notes.push_back(note); }
    }

    fs::path path_;
    ReadOptions options_;
    RotatingModel model_;
    RestingProperties properties_;
    std::vector<TurningMesh> turning_;
    std::size_t models_ = 0;
    std::map<std::string, int> at_rest_; ///< animations, by their types
    std::set<std::string> told_;
};

} // namespace

RotatingModel read_flightgear_model(const fs::path& path, const ReadOptions& options) {
    return FlightGearReading(path, options).read();
}

} // namespace octant::models::meshfile
