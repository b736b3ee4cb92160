#pragma once

#include "models/meshfile/flightgear_rest_placements.h"
#include "models/meshfile/flightgear_rotations.h"
#include "models/meshfile/xml_tree.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace octant::models::meshfile {

/// What the animations of one FlightGear model do to the objects of its mesh and to its
/// sub-models, by their names; axes of that model.
struct FlightGearAnimations {
    /// What a range shows only to eyes farther than some metres away, what a select hides at rest,
    /// what stands for a light's reach, and what is moved along the ground as a shadow. An empty
    /// name stands for all of the model.
    std::set<std::string> hidden;
    std::vector<FlightGearRotation> turns; ///< of objects about the same axis only one
    std::vector<FlightGearRestPlacement>
        moves; ///< in the file's order: the first one moves what others moved
    std::map<std::string, int> at_rest; ///< how many others there are, by their types
    std::vector<std::string> notes;     ///< faults in them; often none

    /// What turns an object; the empty name stands for all of the model. Null for what stays.
    const RotationAxis* axis_of(const std::string& object) const;

    /// Where an object stands at rest; the empty name stands for all of the model. What turns in
    /// flight is not moved: its axis stands where the file has it.
    AffineTransform place_of(const std::string& object) const;
};

/// `root`: of flightgear_tree(file).
FlightGearAnimations
flightgear_animations(const std::filesystem::path& file, const XmlElement& root);

} // namespace octant::models::meshfile
