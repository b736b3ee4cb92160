#include "flightpaths/recorded_track.h"
#include "flightpaths/track_motion.h"
#include "flightpaths/track_recording.h"
#include "tests/flightpaths/generated_tracks.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <vector>

using namespace octant::flightpaths;
using namespace octant::tests;

TEST_CASE("two hundred generated tracks come back as they were flown; the table is tests/evidence/tracks.md's") {
    fmt::print("| kind | tracks | place, m rms | largest | height, m rms | largest | pitch, deg rms | largest | roll, "
               "deg rms | "
               "largest | heading, deg rms | backwards, mm |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    constexpr int of_each_kind = 20;
    for (const std::string_view kind : generated_kinds) {
        std::vector<TrackFigures> figures;
        double allowed_m = 1.0;
        for (int seed = 0; seed < of_each_kind; ++seed) {
            const GeneratedTrack track = generated_track(kind, seed);
            const TrackRecording recording = parse_track_recording(track.log, "generated.csv");
            figures.push_back(figures_of(track, motion_of(recording.aircraft.front()).trajectory));
            // Errors of both axes together.
            allowed_m = std::max(1.0, track.logger.noise_m * std::sqrt(2.0));
            INFO(kind << " " << seed);
            CHECK(figures.back().horizontal_rms_m < allowed_m);
            CHECK(figures.back().vertical_rms_m < std::max(1.0, track.logger.height_step_m / std::sqrt(12.0)));
            CHECK(figures.back().backwards_m < 0.01);
        }
        const TrackFigures all = figures_of_all(figures);
        fmt::print(
            "| {} | {} | {:.2f} | {:.1f} | {:.2f} | {:.1f} | {:.2f} | {:.1f} | {:.2f} | {:.1f} | {:.1f} | {:.0f} |\n",
            kind, figures.size(), all.horizontal_rms_m, all.horizontal_most_m, all.vertical_rms_m, all.vertical_most_m,
            all.pitch_rms_deg, all.pitch_most_deg, all.roll_rms_deg, all.roll_most_deg, all.heading_rms_deg,
            1000.0 * all.backwards_m);
        INFO(kind);
        CHECK(all.pitch_rms_deg < 3.0);
        CHECK(all.roll_rms_deg < 3.0);
        if (kind == "parked") {
            CHECK(all.pitch_most_deg < 2.0);
            CHECK(all.roll_most_deg < 2.0);
        }
    }
    std::fflush(stdout);
}
