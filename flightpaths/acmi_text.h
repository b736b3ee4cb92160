#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// Where an object is, as far as a tape has said: degrees and metres.
struct AcmiSample {
    double time_s = 0.0;
    double longitude_deg = 0.0;
    double latitude_deg = 0.0;
    double altitude_m = 0.0;
    double roll_deg = 0.0;
    double pitch_deg = 0.0;
    double heading_deg = 0.0;
};

/// One object from its first line to the one that takes it away. Its number may then be another's.
struct AcmiObject {
    std::string name;
    std::string type;
    bool has_attitude = false;
    /// In the order of the text; times may not be.
    std::vector<AcmiSample> places;
};

/// The objects of an ACMI text in the order in which they appear. Throws Error with file and line.
std::vector<AcmiObject> parse_acmi_objects(std::string_view text, const std::filesystem::path& file);

} // namespace octant::flightpaths
