// Recordings of the kinds that once were refused or flown wrongly; each was made for this project.
#include "flightpaths/recorded_track.h"
#include "flightpaths/track_recording.h"
#include "sim/base/axes.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "tests/flightpaths/scratch.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <string>

using namespace octant;
using namespace octant::flightpaths;
using Catch::Contains;

namespace {

std::filesystem::path found(const std::string& name) {
    return std::string(OCTANT_SOURCE_DIR) + "/tests/flightpaths/tracks/" + name;
}

TrackRecording found_recording(const std::string& name, const std::string& follow = {}) {
    return parse_track_recording(read_file(found(name)), found(name), follow);
}

/// Northward at one place a second and 1,000 m, or whatever `height_m` is.
void check_northward(const std::string& name, double speed_mps, double height_m, double off_m = 0.7) {
    INFO(name);
    const RecordedTrack track = read_recorded_track(found(name));
    const auto samples = track.trajectory.samples();
    REQUIRE(samples.size() >= 100);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        INFO(i);
        const double since_s = samples[i].time_s - samples[0].time_s;
        CHECK(std::abs(since_s - static_cast<double>(i)) < 1e-6);
        CHECK(std::abs(samples[i].position_m.x) < off_m);
        CHECK(std::abs(samples[i].position_m.y - speed_mps * since_s) < off_m + 0.002 * speed_mps * since_s);
        CHECK(samples[i].position_m.z == Approx(height_m).margin(0.2));
    }
}

} // namespace

TEST_CASE("tables with semicolons and decimal commas, without names, and with zeros at their ends are read") {
    check_northward("csv-comma-decimals.csv", 30.0, 1000.5);
    check_northward("fg-generic-noheader.csv", 30.0, 1000.0);
    check_northward("g1000-no-zeros.csv", 51.4, 914.4);
    check_northward("g1000-zeros.csv", 51.4, 914.4);
    CHECK_THAT(found_recording("g1000-zeros.csv").notes.at(0), Contains("4096 zero bytes at the end"));
    const TrackRecording generic = found_recording("fg-generic-noheader.csv");
    CHECK_THAT(
        generic.notes.at(0), Contains("column 1 is taken as seconds, 2 and 3 as latitude and longitude, 4 as height"));
    CHECK(generic.aircraft[0].samples[5].pitch_rad == Approx(rad_from_deg(2.0)));
}

TEST_CASE("KML, flight data recorder files, byte order marks and tracks without heights are read") {
    check_northward("track.kml", 30.0, 1000.0);
    check_northward("xplane.fdr", 30.0, 1000.0);
    check_northward("igc-bom-lf.igc", 30.0, 1000.0, 1.5);
    check_northward("gpx-no-ele.gpx", 30.0, 300.0);
    CHECK(found_recording("gpx-no-ele.gpx").aircraft[0].heights == HeightKind::Absent);
    CHECK_THAT(found_recording("gpx-no-ele.gpx").notes.at(0), Contains("no heights: flown 300 m above the ground"));
    const TrackRecording fdr = found_recording("xplane.fdr");
    CHECK(fdr.aircraft[0].call_sign == "N1");
    CHECK(fdr.aircraft[0].name == "Cessna_172SP");
    CHECK(fdr.aircraft[0].samples[3].pitch_rad == Approx(rad_from_deg(2.0)));
    CHECK(fdr.begin_utc_s == 1560592800.0); // 2019-06-15, 10 o'clock
    CHECK(found_recording("igc-bom-lf.igc").begin_utc_s == 1560592800.0);
    CHECK(found_recording("track.kml").begin_utc_s == 1560592800.0);
}

TEST_CASE("a leap second and the second after it are two moments") { check_northward("csv-leap.csv", 30.0, 1000.0); }

TEST_CASE("two addresses in one log are two aircraft on one clock") {
    const TrackRecording recording = found_recording("opensky-two-b.csv");
    REQUIRE(recording.aircraft.size() == 2);
    CHECK(recording.aircraft[0].id == "aaaaaa");
    CHECK(recording.aircraft[0].call_sign == "ONE");
    CHECK(recording.aircraft[1].call_sign == "TWO");
    CHECK(recording.aircraft[1].samples.front().time_s == 5.0);
    for (const TrackedAircraft& aircraft : recording.aircraft) {
        for (std::size_t i = 1; i < aircraft.samples.size(); ++i) {
            const TrackSample& a = aircraft.samples[i - 1];
            const TrackSample& b = aircraft.samples[i];
            const double speed_mps = glm::length(b.position_m - a.position_m) / (b.time_s - a.time_s);
            CHECK(speed_mps == Approx(aircraft.call_sign == "ONE" ? 100.0 : 201.0).epsilon(0.01));
        }
    }
    const TrackRecording other = found_recording("opensky-two-b.csv", "two");
    CHECK(other.aircraft[0].id == "bbbbbb");
    CHECK(glm::length(other.aircraft[0].samples.front().position_m - glm::dvec3(0, 0, 3500)) < 1e-6);
}

TEST_CASE("the pilot's own aircraft is followed") {
    const TrackRecording recording = found_recording("player-second.txt.acmi");
    CHECK(recording.aircraft[0].name == "F-14B");
    CHECK(recording.aircraft[0].pilot == "Me");
    CHECK(recording.begin_utc_s == 1577836800.0);
}
