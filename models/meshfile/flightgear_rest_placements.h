#pragma once

#include "models/meshfile/affine_transform.h"
#include "models/meshfile/xml_tree.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>

namespace octant::models::meshfile {

/// Where a `rotate` or `translate` animation puts what it names while all properties are 0: landing
/// gear up, for one. Axes of the FlightGear model.
struct FlightGearRestPlacement {
    std::set<std::string> objects; ///< by name; an empty one: all of the model
    AffineTransform placement;
};

/// Nothing for other animations, for those that leave everything where it is, whose condition does
/// not hold at rest, or that compute an <expression>. Throws Error for faulty numbers.
std::optional<FlightGearRestPlacement>
placement_at_rest(const std::filesystem::path& file, const XmlElement& animation);

} // namespace octant::models::meshfile
