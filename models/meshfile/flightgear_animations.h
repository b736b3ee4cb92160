#pragma once

#include "models/meshfile/flightgear_xml.h"
#include "models/meshfile/mesh_join.h"
#include "models/meshfile/mesh_parts.h"
#include "models/part_motion.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

using ObjectNames = std::set<std::string>;

/// The number in a child of an element of a FlightGear file; `without` where there is none. Throws Error for what is no
/// number, or beyond max_coordinate.
double number_in(const XmlElement& parent, std::string_view name, double without = 0.0);

/// What properties are worth at rest: what an aircraft's -set.xml states, then a table, else nothing, which is 0 or an
/// empty text.
class RestingProperties {
public:
    /// Takes the values below an element of a -set.xml, whose path is `path`.
    void take(const XmlElement& element, const std::string& path, int depth = 0);

    /// The same with a control at a position; shares what the aircraft states.
    RestingProperties with(FlightControl control, double position) const;

    std::string text(std::string_view property) const;

    double number(std::string_view property) const;

private:
    /// By plain paths.
    std::shared_ptr<std::map<std::string, std::string>> values_ =
        std::make_shared<std::map<std::string, std::string>>();
    ControlPositions positions_{};
};

/// Whether the <condition> of a FlightGear animation or sub-model holds at rest. True without a condition. Throws Error
/// for a faulty <expression> in it, as expression_value does.
bool holds_at_rest(const XmlElement& animation, const RestingProperties& properties);

/// The value of the function that an <expression> holds, of numbers and properties; nothing where it is not finite.
/// Throws Error for faulty numbers, functions that are not known and another number of terms than a function takes.
std::optional<double> expression_value(const XmlElement& expression, const RestingProperties& properties);

/// An animation by which something turns in flight; axes of the FlightGear model.
struct FlightGearRotation {
    ObjectNames objects; ///< by name; empty: all of the model
    RotationAxis about;
    double first_angle_rad = 0.0; ///< at which it stands at time 0
    /// Of one blade: its number, and what its rotor is called; the blades stand evenly around the axis.
    std::optional<int> blade = {};
    std::string rotor = {};
};

/// Where a `rotate` or `translate` animation puts what it names at rest, landing gear up, for one, and how a control
/// moves it from there, or shows and hides it. Axes of the FlightGear model.
struct FlightGearRestPlacement {
    ObjectNames objects; ///< by name; an empty one: all of the model
    AffineTransform placement;
    std::optional<PartMove> move = {};
};

PartMoves placed_moves(PartMoves moves, const AffineTransform& placement);

/// What the animations of one FlightGear model do to the objects of its mesh and to its sub-models, by their names;
/// axes of that model.
struct FlightGearAnimations {
    /// What a range shows only to eyes farther than some metres away, what a select hides at rest, what a blend makes
    /// clear at rest (0.99 and more), what stands for a light's reach, and what is moved along the ground as a shadow.
    /// An empty name stands for all of the model.
    ObjectNames hidden;
    std::vector<FlightGearRotation> turns;      ///< of objects about the same axis only one
    std::vector<FlightGearRestPlacement> moves; ///< in the file's order: the first one moves what others moved
    std::map<std::string, int> at_rest;         ///< how many others there are, by their types
    /// Pictures that a `material` animation puts on objects while its properties are not set; "" = on all others.
    std::map<std::string, std::string> pictures;
    /// Of each faulty animation, which is left out: its first fault, with file and line; often none.
    std::vector<std::string> notes;

    /// Adds what the animations of an outer model do to objects of these names: in FlightGear they hold for all models
    /// within it. `placement`: of this model in the outer one. The turns of both are in axes of the whole.
    void add_outer(const FlightGearAnimations& outer, const AffineTransform& placement, const ObjectNames& names);

    /// What turns an object; the empty name stands for all of the model. Null for what stays.
    const FlightGearRotation* turn_of(const std::string& object) const;

    /// Where an object stands at rest; the empty name stands for all of the model. What turns in flight is not moved:
    /// its axis stands where the file has it.
    AffineTransform place_of(const std::string& object) const;

    /// How controls move an object from there; the empty name stands for all of the model.
    PartMoves moves_of(const std::string& object) const;
};

/// `root`: the outermost element of a model's file, with what it includes.
FlightGearAnimations flightgear_animations(const XmlElement& root, const RestingProperties& properties);

AffineTransform turned_about(const RotationAxis& axis, double angle_rad);

/// A property's path without a slash in front and without indices of 0.
std::string plain_path(std::string_view path);

} // namespace octant::models::meshfile
