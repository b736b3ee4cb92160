#pragma once

#include "ui/base/study_output.h"
#include "ui/settings/settings.h"

#include <string>

namespace octant::ui::studies::draw_order {

struct HiddenSurfaceStudyOptions : base::StudyOutput {
    settings::RunSettings settings =
        settings::measurement_settings(); ///< terrain, triangles and context are taken from it
    bool race = true;                ///< frames a second of the three ways
    bool pictures = true;            ///< polygon numbers against the depth buffer
    bool rays = true;                ///< polygon numbers against rays
    int race_frames = 200;
    int every = 10;       ///< every Nth frame is compared
    std::string aircraft; ///< compared in place of F-15 and 500MD, unless empty
    int jobs = 1;         ///< views of a flight compared at once; the race is one at a time
};

/// Three tables. Frames a second of octant order, depth buffer and removal of back faces, drawn in
/// turn, for 1 to 1000 aircraft over the 60-polygon background and over terrain, 640x480 and
/// 1280x720. And pictures of polygon numbers, octant order against the depth buffer, for four
/// paths, two aircraft and four views over terrain: chase, tower, a tower that sees the aircraft go
/// behind ridges, and orbit. And the same pictures, and those from the cockpit, by both renderers
/// against rays. Prints them and writes them to `out` as CSV and Markdown. True when no pixel was
/// wrong. Throws Error.
bool study_hidden_surface(const HiddenSurfaceStudyOptions& study);

} // namespace octant::ui::studies::draw_order
