#include "flightpaths/recorded_track.h"
#include "flightpaths/track_motion.h"
#include "flightpaths/track_recording.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <string>

using namespace octant;
using namespace octant::flightpaths;
using Catch::Contains;

namespace {

const std::string head = "FileType=text/acmi/tacview\nFileVersion=2.2\n";

TrackRecording recording_of(const std::string& lines, const std::string& follow = {}) {
    return parse_track_recording(head + lines, "a.acmi", follow);
}

constexpr double degree_north_m = 111132.954 - 559.822 + 1.175; // of the meridian at the equator

} // namespace

TEST_CASE("what a line leaves out of a place stays, and references are added") {
    const TrackRecording recording = recording_of("0,ReferenceLongitude=8\n0,ReferenceLatitude=0\n#10\n"
                                                  "a1,T=0.5|0.001|150|10|0|90,Name=F-15C,Type=Air+FixedWing\n"
                                                  "#11\na1,T=|0.002||||\n#12\na1,T=|0.003|160|||80\n");
    REQUIRE(recording.aircraft.size() == 1);
    const TrackedAircraft& aircraft = recording.aircraft.front();
    CHECK(aircraft.name == "F-15C");
    CHECK(aircraft.type == "Air+FixedWing");
    CHECK(recording.origin->longitude_deg == 8.5);
    CHECK(recording.origin->latitude_deg == 0.001);
    const sim::Trajectory motion = motion_of(aircraft).trajectory;
    const auto samples = motion.samples();
    REQUIRE(samples.size() == 3);
    CHECK(samples[0].time_s == 0.0);
    CHECK(samples[2].time_s == 2.0);
    CHECK(samples[1].position_m.y == Approx(0.001 * degree_north_m).epsilon(1e-4));
    CHECK(samples[1].position_m.x == Approx(0.0).margin(1e-9));
    CHECK(samples[1].position_m.z == 150.0);
    CHECK(samples[2].position_m.z == 160.0);
    const EulerAngles last = euler_from_body_to_world(samples[2].body_to_world);
    CHECK(last.heading_rad == Approx(rad_from_deg(80.0)));
    CHECK(last.roll_rad == Approx(rad_from_deg(10.0)));
    CHECK(samples[1].velocity_mps.y == Approx(0.001 * degree_north_m).epsilon(1e-4));
}

TEST_CASE("a recording's aircraft share one clock and one origin, the one seen longest first") {
    const TrackRecording recording = recording_of("#0\n1,T=0|0|100,Type=Air+Rotorcraft\n2,T=0.01|0|300\n#1\n"
                                                  "1,T=0.0001|0|100\n2,T=0.011|0|300\n#1.5\n-1\n#2\n2,T=0.012|0|300\n"
                                                  "1,T=1|1|5,Type=Air+FixedWing,Name=another\n#3\n1,T=1.001|1|5\n");
    REQUIRE(recording.aircraft.size() == 3);
    CHECK(recording.aircraft[0].type.empty());
    CHECK(recording.aircraft[0].samples.back().time_s == 2.0);
    CHECK(recording.aircraft[1].type == "Air+Rotorcraft");
    CHECK(recording.aircraft[1].samples.back().time_s == 1.0);
    CHECK(recording.aircraft[2].name == "another");
    CHECK(recording.aircraft[2].samples.front().time_s == 2.0);
    CHECK(recording.origin->longitude_deg == 0.01);
    CHECK(recording.aircraft[1].samples[0].position_m.x < -1000.0);
}

TEST_CASE("lines out of order, escapes, lines that go on and comments are read as the format says") {
    const TrackRecording recording =
        recording_of("// a comment\n0,Title=one\\, two\\\nthree,Author=x\n#2\n"
                     "1,T=0.002|0|10,Name=a\\,b\n#1\n1,T=0.001|0|10\n#2\n1,T=0.003|0|10\n");
    REQUIRE(recording.aircraft.size() == 1);
    CHECK(recording.aircraft[0].name == "a,b");
    const auto& samples = recording.aircraft[0].samples;
    REQUIRE(samples.size() == 2);
    CHECK(samples[0].time_s == 0.0);
    CHECK(samples[1].time_s == 1.0);
    CHECK(samples[1].position_m.x - samples[0].position_m.x == Approx(0.002 * 111319.5).epsilon(1e-4));
}

TEST_CASE("what is no aircraft, seen once or impossible is left out and told") {
    const TrackRecording recording =
        recording_of("#0\n1,T=0|0|10\n2,T=0|0|0,Type=Ground+Tank\n3,T=0|0|10,Type=Air+FixedWing\n"
                     "4,T=50|0|10,Type=Air+FixedWing\n-3\n#1\n1,T=0.001|0|10\n2,T=0.001|0|0\n4,T=50.001|0|10\n"
                     "#2\n1,T=1|0|10\n#3\n1,T=0.002|0|10\n1,T=0.002|95|10\n");
    REQUIRE(recording.aircraft.size() == 1);
    CHECK(recording.aircraft[0].samples.size() == 3);
    REQUIRE(recording.notes.size() == 5);
    CHECK_THAT(recording.notes[0], Contains("1 objects that are no aircraft"));
    CHECK_THAT(recording.notes[1], Contains("1 samples off the earth"));
    CHECK_THAT(recording.notes[2], Contains("1 that only a jump leads to"));
    CHECK_THAT(recording.notes[3], Contains("1 aircraft that are seen at one time alone"));
    CHECK_THAT(recording.notes[4], Contains("1 aircraft more than 1,000 km away"));
}

TEST_CASE("a recording of more objects than any battle has is refused at the first too many") {
    constexpr int most = 1000000;
    std::string lines;
    for (int i = 1; i <= most + 1; ++i) {
        lines += std::to_string(i) + ",\n"; // decimal digits are numbers in hexadecimal, too
    }
    CHECK_THROWS_WITH(
        recording_of(lines), Contains("a.acmi:1000003: expected at most 1000000 objects, got '1000001,'"));
}

TEST_CASE("what is no recording is refused in one line that names its place") {
    struct Case {
        std::string text;
        std::string expected;
    };

    const std::vector<Case> cases{
        {"FileType=text\n", "a.acmi:1: expected FileType=text/acmi/tacview, got 'FileType=text'"},
        {"FileType=text/acmi/tacview\nFileVersion=1.0\n", "a.acmi:2: expected FileVersion=2.x"},
        {head + "#x\n", "a.acmi:3: expected a number, got 'x'"},
        {head + "#0\nzz,T=0|0|0\n", "a.acmi:4: expected an object's number in hexadecimal digits"},
        {head + "1,T=0|0\n", "a.acmi:3: expected 3, 5, 6 or 9 components after T=, got '0|0'"},
        {head + "1,T=0|nan|0\n", "a.acmi:3: expected a number, got 'nan'"},
        {head + "#0\n#1e9\n", "a.acmi:4: expected a time within 86400 s of the first"},
        {head + "#0\n1,T=0|0|0\n", "a.acmi: expected at least 2 samples with a place, got 1"}};
    for (const Case& wrong : cases) {
        CHECK_THROWS_WITH(parse_track_recording(wrong.text, "a.acmi"), Contains(wrong.expected));
    }
}

TEST_CASE("the pilot of the recording is followed, else the longest flight that goes somewhere, or who is asked for") {
    const std::string parked = "1,T=0|0|30,Type=Air+FixedWing,Name=Yak-40\n2,T=0.1|0|900,Type=Air+FixedWing,Name=F-14B,"
                               "Pilot=Me";
    const std::string rest = "\n#1\n1,T=|0.00001|\n2,T=|0.002|\n#2\n2,T=|0.004|\n#3\n1,T=|0|\n";
    CHECK(recording_of("#0\n" + parked + rest).aircraft[0].name == "F-14B");
    const TrackRecording named = recording_of("#0\n" + parked + rest, "yak-40");
    CHECK(named.aircraft[0].name == "Yak-40");
    CHECK(named.aircraft[1].name == "F-14B");
    CHECK(recording_of("#0\n" + parked + ",Importance=0" + rest, "me").aircraft[0].pilot == "Me");
    CHECK(recording_of("#0\n1,T=0|0|9,Name=A\n2,T=0|0.1|9,Name=B,Importance=1\n#1\n1,T=0.01|0|9\n2,T=0|0.1|9\n")
              .aircraft[0]
              .name == "B");
    CHECK_THROWS_WITH(recording_of("#0\n" + parked + rest, "Bear"),
        "--follow: expected one of the 2 aircraft (Yak-40, F-14B), got 'Bear'");
}
