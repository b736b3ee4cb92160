#include "flightpaths/derived_motion.h"
#include "flightpaths/recorded_track.h"
#include "flightpaths/track_writer.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "tests/flightpaths/track_fault.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>

using namespace octant;
using namespace octant::flightpaths;
using octant::tests::shipped;
using octant::tests::track_fault;
using octant::tests::written;

namespace {

RecordedTrack track_of(const std::string& text) { return read_recorded_track(written("track.csv", text)); }

const std::string own_head = "t_s,north_m,east_m,alt_m\n";

/// Samples on a level circle to the right, 20 a second.
std::vector<sim::AircraftState> circle(double radius_m, double speed_mps, int count) {
    std::vector<sim::AircraftState> samples;
    for (int i = 0; i < count; ++i) {
        sim::AircraftState state;
        state.time_s = 0.05 * i;
        const double angle = speed_mps / radius_m * state.time_s;
        state.position_m = {radius_m * (1.0 - std::cos(angle)), radius_m * std::sin(angle), 500.0};
        samples.push_back(state);
    }
    return samples;
}

} // namespace

TEST_CASE("own columns are found by name in any order, others are passed over") {
    const RecordedTrack track = track_of("alt_m, t_s ,colour,east_m,north_m,yaw_deg,roll_deg,"
                                         "pitch_deg,n_g\r\n"
                                         "100,0,red,5,0,0,30,0,2\r\n"
                                         "100,1,red,5,50,0,30,0,2\r\n\r\n");
    REQUIRE(track.trajectory.samples().size() == 2);
    const sim::AircraftState& first = track.trajectory.samples()[0];
    CHECK(first.position_m.x == 5);
    CHECK(first.position_m.z == 100);
    CHECK(first.velocity_mps.y == Approx(50));
    CHECK(first.load_factor == 2);
    CHECK(euler_from_body_to_world(first.body_to_world).roll_rad == Approx(rad_from_deg(30)));
    CHECK_FALSE(track.origin);
}

TEST_CASE("heading_deg stands for yaw_deg, and each angle counts where the others are missing") {
    const RecordedTrack whole = track_of("t_s,north_m,east_m,alt_m,roll_deg,pitch_deg,heading_deg\n"
                                         "0,0,0,100,30,5,90\n1,0,50,100,30,5,90\n");
    const auto angles = euler_from_body_to_world(whole.trajectory.samples()[0].body_to_world);
    CHECK(angles.roll_rad == Approx(rad_from_deg(30)));
    CHECK(angles.pitch_rad == Approx(rad_from_deg(5)));
    CHECK(angles.heading_rad == Approx(rad_from_deg(90)));
    const RecordedTrack backwards = track_of("t_s,north_m,east_m,alt_m,heading_deg\n"
                                             "0,0,0,100,350\n1,50,0,100,350\n2,100,0,100,350\n");
    const auto nose = euler_from_body_to_world(backwards.trajectory.samples()[1].body_to_world);
    CHECK(std::remainder(nose.heading_rad - rad_from_deg(350), rad_from_deg(360)) == Approx(0.0).margin(0.02));
}

TEST_CASE("quotes around names and numbers are no part of them") {
    const RecordedTrack track = track_of("\"t_s\";\"north_m\";\"east_m\";\"alt_m\"\n\"0\";\"5\";0;\"7\";\n1;5;0;8\n");
    REQUIRE(track.trajectory.samples().size() == 2);
    CHECK(track.trajectory.samples()[0].position_m == glm::dvec3(0.0, 5.0, 7.0));
}

TEST_CASE("JSBSim columns come with tabs, commas or semicolons, in feet, with the geodetic latitude") {
    for (const char separator : {',', '\t', ';'}) {
        std::string text = "Time;Altitude ASL (ft);Phi (deg);Theta (deg);Psi (deg);Latitude (deg);"
                           "Latitude Geodetic (deg);Longitude (deg);V_{North} (ft/s);V_{East} "
                           "(ft/s);V_{Down} (ft/s)\n"
                           "0;1000;10;5;90;37.2;37.4;127.1;0;328.084;-32.8084\n"
                           "1;1032.8084;10;5;90;37.2;37.401;127.1;0;328.084;-32.8084\n"
                           "2;1065.6168;10;5;90;37.2;37.4;127.102;0;328.084;-32.8084\n";
        for (char& c : text) { c = c == ';' ? separator : c; }
        const RecordedTrack track = track_of(text);
        REQUIRE(track.origin);
        CHECK(track.origin->latitude_deg == 37.4);
        CHECK(track.origin->longitude_deg == 127.1);
        const auto samples = track.trajectory.samples();
        CHECK(samples[0].position_m.x == 0);
        CHECK(samples[0].position_m.z == Approx(304.8));
        // A thousandth of a degree on WGS 84 at 37.4 degrees north: 111.0 m and 88.5 m.
        CHECK(samples[1].position_m.y == Approx(110.99).margin(0.02));
        CHECK(samples[2].position_m.x == Approx(2 * 88.55).margin(0.04));
        CHECK(samples[1].velocity_mps.x == Approx(100).epsilon(1e-5));
        CHECK(samples[1].velocity_mps.z == Approx(10).epsilon(1e-5));
        const EulerAngles angles = euler_from_body_to_world(samples[1].body_to_world);
        CHECK(angles.heading_rad == Approx(pi / 2));
        CHECK(angles.roll_rad == Approx(rad_from_deg(10)));
    }
}

TEST_CASE("a latitude of JSBSim that is geocentric becomes the geodetic one") {
    // JSBSim itself gives 47.19191 for a start at a geocentric 47.
    const RecordedTrack track = track_of("Time,Latitude (deg),Longitude (deg),Altitude ASL (ft)\n"
                                         "0,47,8,0\n1,47,8.00001,0\n");
    REQUIRE(track.origin);
    CHECK(track.origin->latitude_deg == Approx(47.19191).margin(1e-5));
}

TEST_CASE("a flight over the date line is whole") {
    const RecordedTrack track = track_of("Time,Latitude (deg),Longitude (deg),Altitude ASL (ft)\n"
                                         "0,10,179.9999,100\n1,10,-179.9999,100\n");
    CHECK(track.trajectory.samples()[1].position_m.x == Approx(21.93).margin(0.05));
}

TEST_CASE("a flight over the pole is whole") {
    const RecordedTrack track = track_of("Time,Latitude Geodetic (deg),Longitude (deg),Altitude ASL (ft)\n"
                                         "0,89.999,20,100\n1,89.999,-160,100\n");
    const glm::dvec3 behind_m = track.trajectory.samples()[1].position_m;
    CHECK(behind_m.x == Approx(0.0).margin(1e-6));
    CHECK(behind_m.y == Approx(223.39).margin(0.01));
}

TEST_CASE("velocity, bank and load factor of a circle come out of its positions") {
    auto samples = circle(1000.0, 100.0, 200);
    fill_velocities(samples);
    fill_attitudes(samples);
    fill_load_factors(samples);
    const double bank = std::atan(100.0 * 100.0 / 1000.0 / gravity_mps2);
    for (std::size_t i = 3; i + 3 < samples.size(); ++i) {
        const EulerAngles angles = euler_from_body_to_world(samples[i].body_to_world);
        CHECK(glm::length(samples[i].velocity_mps) == Approx(100).epsilon(1e-4));
        CHECK(angles.roll_rad == Approx(bank).epsilon(1e-3));
        CHECK(angles.pitch_rad == Approx(0).margin(1e-6));
        CHECK(samples[i].load_factor == Approx(1 / std::cos(bank)).epsilon(1e-3));
    }
    CHECK(samples.front().velocity_mps.y == Approx(100).epsilon(1e-3));
}

TEST_CASE("velocities are exact for a parabola, also with uneven times") {
    std::vector<sim::AircraftState> samples(5);
    const double times[] = {0, 0.3, 0.4, 1.0, 1.2};
    for (std::size_t i = 0; i < 5; ++i) {
        samples[i].time_s = times[i];
        samples[i].position_m.z = 3 + 2 * times[i] - 4 * times[i] * times[i];
    }
    fill_velocities(samples);
    for (std::size_t i = 0; i < 5; ++i) { CHECK(samples[i].velocity_mps.z == Approx(2 - 8 * times[i])); }
}

TEST_CASE("an aircraft that stands still or falls keeps an attitude") {
    const RecordedTrack still = track_of(own_head + "0,1,1,1\n1,1,1,1\n2,1,1,1\n");
    CHECK(still.trajectory.samples()[1].load_factor == Approx(1));
    std::string fall = own_head;
    for (int i = 0; i < 10; ++i) { fall += std::to_string(i) + ",0,0," + std::to_string(1000 - 100 * i) + "\n"; }
    const RecordedTrack falling = track_of(fall);
    for (const auto& state : falling.trajectory.samples()) { CHECK(glm::length(state.body_to_world) == Approx(1)); }
}

TEST_CASE("wrong tracks are refused with line and what was expected") {
    CHECK_THROWS_WITH(read_recorded_track("/nowhere/a.csv"), "/nowhere/a.csv: expected a file, found none");
    CHECK(track_fault("") == "1: expected a line of column names, got an empty one");
    CHECK(track_fault("a,b\n1,2\n") ==
          "1: expected column names with a time and a place among them (t_s, north_m, east_m, alt_m or Time, Latitude, "
          "Longitude, Altitude), or a file of a known format, got a,b");
    CHECK(track_fault("t_s,north_m,alt_m\n") == "1: expected a column east_m, got 't_s,north_m,alt_m'");
    CHECK(track_fault("Time,Longitude (deg),Altitude ASL (ft)\n") ==
          "1: expected a column Latitude Geodetic (deg), got 'Time,Longitude (deg),Altitude ASL (ft)'");
    CHECK(track_fault("t_s,t_s,north_m,east_m,alt_m\n") == "1: expected column t_s once, got it twice");
    CHECK(track_fault(own_head) == " expected at least 2 samples, got 0");
    CHECK(track_fault(own_head + "0,0,0,0\n") == " expected at least 2 samples, got 1");
    CHECK(track_fault(own_head + "0,0,0,0\n1,0,0\n") == "3: expected 4 fields, got 3");
    CHECK(track_fault(own_head + "0,0,0,0,\n1,0,0,0,5\n") == "3: expected 4 fields, got 5");
    CHECK(track_fault(own_head + "0,0,0,0\n1,0,nan,0\n") == "3: expected a finite number in column east_m, got 'nan'");
    CHECK(track_fault(own_head + "0,0,0,0\n1,0,1e999,0\n") ==
          "3: expected a finite number in column east_m, got '1e999'");
    CHECK(track_fault(own_head + "0,0,0,0\n\n1,0,,0\n") == "4: expected a finite number in column east_m, got ''");
    CHECK(track_fault(own_head + "0,0,0,0\n1,0,0,0\n1,0,0,0\n") == "4: expected a time after 1.000 s, got 1.000 s");
    CHECK(track_fault(own_head + "0,0,0,0\n1e6,0,0,0\n") ==
          "3: expected a time within 86400 s of the first, got 1000000.000 s");
    CHECK(track_fault(own_head + "1e9,0,0,0\n1000000001,0,0,0\n") ==
          "2: expected a time from -10000000 s to 10000000 s, got 1000000000 s");
    CHECK(track_fault(own_head + "-1e300,0,0,0\n0,0,0,0\n") ==
          "2: expected a time from -10000000 s to 10000000 s, got -1e+300 s");
    CHECK(track_fault(own_head + "1e7,0,0,0\n10000001,0,0,0\n") ==
          "3: expected a time from -10000000 s to 10000000 s, got 10000001 s");
    CHECK(track_fault(own_head + "9999999,0,0,0\n1e7,0,0,0\n") == "no error");
    CHECK(track_fault(own_head + "0,0,0,0\n1,0,0,4000\n") == "3: expected a speed of at most 3000 m/s, got 4000.0 m/s");
    CHECK(track_fault(own_head + "0,0,1e8,0\n1,0,0,0\n") ==
          "2: expected a place within 10000 km of the origin, got 100000 km");
    CHECK(track_fault("Time,Latitude (deg),Longitude (deg),Altitude ASL (ft)\n0,95,0,0\n") ==
          "2: expected a latitude within 90 deg and a longitude within 360 deg, got 95 and 0");
    CHECK(track_fault(std::string("t_s\0,", 5)) ==
          " expected text or a known format of flight recordings, got binary data");
}

TEST_CASE("every cut of a good track is read or refused, never worse") {
    const std::string good = "t_s,north_m,east_m,alt_m,n_g\n0,0,0,100,1\n1,50,0,100,1\n2,99,0,100,1";
    for (std::size_t length = 0; length < good.size(); ++length) {
        const std::string fault = track_fault(good.substr(0, length));
        CHECK(fault.find('\n') == std::string::npos);
    }
}

TEST_CASE("a written track reads back as the same states") {
    for (const char* name : {"f15-pop-up", "500md-jinking"}) {
        const PathScript script = read_path_script(shipped(name));
        const FlownPath path = fly(script, sim::aircraft_kind(script.aircraft), false);
        const RecordedTrack back = track_of(track_csv(path.trajectory));
        REQUIRE(back.trajectory.samples().size() == path.trajectory.samples().size());
        for (std::size_t i = 0; i < path.trajectory.samples().size(); ++i) {
            const sim::AircraftState& a = path.trajectory.samples()[i];
            const sim::AircraftState& b = back.trajectory.samples()[i];
            CHECK(b.time_s == Approx(a.time_s).margin(1e-6));
            CHECK(glm::length(a.position_m - b.position_m) < 1e-3);
            CHECK(glm::length(a.velocity_mps - b.velocity_mps) < 1e-3);
            CHECK(std::abs(glm::dot(a.body_to_world, b.body_to_world)) > 1 - 1e-9);
            CHECK(a.load_factor == Approx(b.load_factor).margin(1e-3));
        }
    }
}
