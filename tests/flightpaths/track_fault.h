#pragma once

#include "flightpaths/recorded_track.h"
#include "sim/base/error.h"
#include "tests/flightpaths/scratch.h"

#include <string>

namespace octant::tests {

/// What reading a recorded track of this text is refused with, without the file's name.
inline std::string track_fault(const std::string& text) {
    const auto file = written("fault.csv", text);
    try {
        flightpaths::read_recorded_track(file);
    } catch (const Error& error) { return std::string(error.what()).substr(file.string().size() + 1); }
    return "no error";
}

} // namespace octant::tests
