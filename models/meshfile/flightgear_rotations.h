#pragma once

#include "models/meshfile/rotating_model.h"
#include "models/meshfile/xml_tree.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>

namespace octant::models::meshfile {

/// An animation by which something turns in flight; axes of the FlightGear model.
struct FlightGearRotation {
    std::set<std::string> objects; ///< by name; empty: all of the model
    RotationAxis about;
};

/// What an animation turns while the aircraft flies: `spin` of engines and rotors, `rotate` by a
/// rotor's angle. They turn as at cruise, since a file says by which property only: propellers at
/// 2400 turns a minute, main rotors at 390, tail rotors at 2000, turbines at 90 per cent. `spin` by
/// a property that does not say what it is of turns what is called rotor, propeller or blade: about
/// a mostly upright axis as a main rotor, along as a propeller, across as a tail rotor. Nothing for
/// wheels, instruments and all other animations. Throws Error for faulty numbers.
std::optional<FlightGearRotation>
rotation_in_flight(const std::filesystem::path& file, const XmlElement& animation);

} // namespace octant::models::meshfile
