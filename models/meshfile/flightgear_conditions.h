#pragma once

#include "models/meshfile/xml_tree.h"

namespace octant::models::meshfile {

/// Whether the <condition> of a FlightGear animation holds while all properties are 0 but for the
/// view, which is one from outside: an aircraft as it stands in its file, gear up, doors shut,
/// lights off. True without a condition.
bool holds_at_rest(const XmlElement& animation);

} // namespace octant::models::meshfile
