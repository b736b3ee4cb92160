#include "flightpaths/recorded_track.h"
#include "flightpaths/track_motion.h"
#include "flightpaths/track_recording.h"
#include "flightpaths/track_writer.h"
#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "tests/flightpaths/scratch.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <string>
#include <utility>

using namespace octant;
using namespace octant::flightpaths;
using Catch::Contains;

namespace {

TrackRecording recorded(const std::string& text, const std::string& follow = {}) {
    return parse_track_recording(text, "track", follow);
}

std::string notes_in(const TrackRecording& recording) {
    std::string all;
    for (const std::string& note : recording.notes) { all += note + "\n"; }
    return all;
}

template <class Number>
std::string raw(Number number) {
    std::string bytes(sizeof(number), '\0');
    std::memcpy(bytes.data(), &number, sizeof(number));
    return bytes;
}

std::string zero_filled(std::string text, std::size_t size) {
    text.resize(size, '\0');
    return text;
}

} // namespace

TEST_CASE("a KML line without times is flown at a stated speed, above the ground where it says so") {
    const TrackRecording line = recorded("<kml><Placemark><LineString><altitudeMode>relativeToGround</altitudeMode>"
                                         "<coordinates>8,47,100 8.01,47,100\n8.02,47,120</coordinates></LineString>"
                                         "</Placemark></kml>");
    REQUIRE(line.aircraft.size() == 1);
    CHECK(line.aircraft[0].heights == HeightKind::AboveGround);
    const auto& samples = line.aircraft[0].samples;
    REQUIRE(samples.size() == 3);
    CHECK(glm::length(samples[1].position_m - samples[0].position_m) / samples[1].time_s == Approx(60.0).epsilon(0.01));
    CHECK_THAT(notes_in(line), Contains("the line has no times: flown at 60 m/s"));
    CHECK_THROWS_WITH(
        recorded("<kml><Placemark><gx:Track><when>2024-01-02T07:00:00Z</when></gx:Track></Placemark></kml>"),
        Contains("track:1: expected as many places (gx:coord) as times (when), got 0 and 1"));
    CHECK_THROWS_WITH(recorded("<kml>\n<Placemark>"), Contains("expected well-formed XML"));
}

TEST_CASE("tracks of a KML or GPX file that follow one another are one flight, at the same time several aircraft") {
    const auto track = [](const std::string& name, const std::string& second) {
        return fmt::format("<trk><name>{}</name><trkseg><trkpt lat='47' lon='8'><ele>5</ele><time>2024-01-02T00:00:{}0Z"
                           "</time></trkpt><trkpt lat='47.001' lon='8'><ele>5</ele><time>2024-01-02T00:00:{}5Z</time>"
                           "</trkpt></trkseg></trk>",
            name, second, second);
    };
    CHECK(recorded("<gpx>" + track("A", "0") + track("B", "1") + "</gpx>").aircraft.size() == 1);
    const TrackRecording two = recorded("<gpx>" + track("A", "0") + track("B", "0") + "</gpx>", "b");
    REQUIRE(two.aircraft.size() == 2);
    CHECK(two.aircraft[0].call_sign == "B");
}

TEST_CASE("a GPX track over several days is its flights, of which the longest is followed") {
    std::string points;
    for (const auto& [day, count] : {std::pair(1, 3), std::pair(2, 9), std::pair(4, 4)}) {
        for (int i = 0; i < count; ++i) {
            points += fmt::format(
                "<trkpt lat='47.00{}' lon='8'><ele>500</ele><time>2024-05-0{}T10:00:0{}Z</time></trkpt>", i, day, i);
        }
    }
    const TrackRecording days = recorded("<gpx><trk><trkseg>" + points + "</trkseg></trk></gpx>");
    REQUIRE(days.aircraft.size() == 3);
    CHECK(days.aircraft[0].samples.size() == 9);
    CHECK(days.aircraft[0].samples.front().time_s == 86400.0);
    CHECK_THAT(notes_in(days), Contains("stood for more than an hour: 3 flights"));
}

TEST_CASE("a GPX track without times, or all of one moment, is flown at a stated speed") {
    for (const std::string time :
        {"", "<time>2024-05-01T10:00:00Z</time>", "<time>1901-12-13T20:45:52.207{}Z</time>"}) {
        std::string points;
        for (int i = 0; i < 4; ++i) {
            points += fmt::format("<trkpt lat='47.00{}' lon='8'>", i) + fmt::format(fmt::runtime(time), i) + "</trkpt>";
        }
        const TrackRecording line = recorded("<gpx><trk><trkseg>" + points + "</trkseg></trk></gpx>");
        CHECK(line.aircraft[0].samples.size() == 4);
        CHECK(line.aircraft[0].samples[3].time_s == Approx(3.0 * 111.2 / 60.0).epsilon(0.01));
        CHECK_THAT(notes_in(line), Contains("the line has no times: flown at 60 m/s"));
    }
}

TEST_CASE("a line with narrow bends is flown as slowly as they ask for; of several lines the longest is flown") {
    std::string zigzag;
    for (int i = 0; i < 20; ++i) {
        zigzag += fmt::format("{},{:.5f},100 ", i % 2 == 0 ? "8" : "8.0001", 47 + i * 1e-4);
    }
    const std::string line = "<LineString><coordinates>{}</coordinates></LineString>";
    const TrackRecording recording =
        recorded("<kml><Placemark>" + fmt::format(fmt::runtime(line), "9,47,0 9.001,47,0") +
                 fmt::format(fmt::runtime(line), zigzag) + "</Placemark></kml>");
    REQUIRE(recording.aircraft.size() == 1);
    CHECK(recording.aircraft[0].samples.size() == 20);
    CHECK_THAT(notes_in(recording), Contains("flown at 11 m/s"));
    CHECK_THAT(notes_in(recording), Contains("left out 1 lines shorter"));
}

TEST_CASE("points of a KML file may have the time span in which they are shown") {
    const TrackRecording points = recorded(
        "<kml><Placemark><Point><coordinates>8,47,100</coordinates></Point><TimeSpan><end>2024-01-02T07:00:00Z</end>"
        "</TimeSpan></Placemark>"
        "<Placemark><Point><coordinates>8,47.001,100</coordinates></Point><TimeSpan><begin>2024-01-02T07:00:00Z"
        "</begin></TimeSpan></Placemark>"
        "<Placemark><Point><coordinates>8,47.002,100</coordinates></Point><TimeSpan><begin>2024-01-02T07:00:05Z"
        "</begin></TimeSpan></Placemark></kml>");
    REQUIRE(points.aircraft[0].samples.size() == 2);
    CHECK(points.aircraft[0].samples[1].time_s == 5.0);
}

TEST_CASE("an aircraft with a single place in an ACMI recording stands there until it is taken away") {
    const TrackRecording parked =
        recorded("FileType=text/acmi/tacview\nFileVersion=2.2\n#0\n"
                 "1,T=8|47|500,Type=Air+FixedWing,Name=A\n2,T=8.001|47|500,Type=Air+FixedWing\n"
                 "#5\n1,T=8.01||\n#9\n-2\n1,T=8.02||\n#20\n1,T=8.03||\n");
    REQUIRE(parked.aircraft.size() == 2);
    CHECK(parked.aircraft[1].samples.size() == 2);
    CHECK(parked.aircraft[1].samples[1].time_s == 9.0);
    CHECK(parked.aircraft[1].samples[1].position_m == parked.aircraft[1].samples[0].position_m);
}

TEST_CASE("a flight data recorder file of the first versions has DATA rows, its clock and true headings") {
    const TrackRecording fdr = recorded("I\n1\nACFT,Aircraft/Heavy/Boeing 747.acf\nTAIL,N8141Q\nTIME,18:54:32\n"
                                        "DATE,03/05/02\nDATA,0,15,8.0,47.0,1000,0,0,0,0,2.5,-10,90,250,0\n"
                                        "DATA,1,15,8.001,47.0,1000,0,0,0,0,2.5,-10,90,250,0\n");
    const TrackSample& sample = fdr.aircraft[0].samples[1];
    CHECK(sample.position_m.z == Approx(304.8));
    CHECK(sample.roll_rad == Approx(rad_from_deg(-10.0)));
    CHECK(sample.heading_rad == Approx(rad_from_deg(90.0)).margin(1e-3));
    CHECK(fdr.begin_utc_s == 1015354472.0); // 2002-03-05 18:54:32
    CHECK_THROWS_WITH(recorded("A\n1\nDATA,0,15,8.0,x,1000,0,0,0,0,2.5,-10,90\n"),
        "track:3: expected a latitude in degrees, got 'x'");
}

TEST_CASE("Data.txt of X-Plane is read by its names, and again after each head") {
    const std::string head = "   _real,_time |   _totl,_time | pitch,__deg | _roll,__deg | hding,_true | __lat,__deg | "
                             "__lon,__deg | __alt,ftmsl |\n";
    const TrackRecording data = recorded(head + "1.0 | 0.5 | 2 | 10 | 90 | 47 | 8 | 1000 |\n" + head +
                                         "3.0 | 1.5 | 2 | 10 | 90 | 47 | 8.001 | 1000 |\n1 | 2 |\n");
    REQUIRE(data.aircraft[0].samples.size() == 2);
    CHECK(data.aircraft[0].samples[1].time_s == 1.0);
    CHECK(data.aircraft[0].samples[1].roll_rad == Approx(rad_from_deg(10.0)));
}

TEST_CASE("messages of a Mode S receiver are the aircraft of their addresses, with their last speeds") {
    const auto at = [](const char* kind, const char* address, int second, const std::string& rest) {
        return fmt::format("MSG,{},1,1,{},1,2016/03/11,13:07:{:02}.000,2016/03/11,13:07:{:02}.000,{}\n", kind, address,
            second, second, rest);
    };
    const TrackRecording messages = recorded(
        "listening\n" + at("1", "4CA2D6", 1, "RYR1  ,,,,,,,,,,,0") + at("4", "4CA2D6", 2, ",,400,90,,,-600,,,,,0") +
        at("3", "4CA2D6", 3, ",36000,,,51,7,,,0,,0,0") + at("3", "4CA2D6", 3, ",36000,,,51,-4.8e30,,,0,,0,0") +
        at("3", "400F00", 3, ",900,,,51.2,7,,,0,,0,0") + at("3", "4CA2D6", 4, ",36000,,,51,7.003,,,0,,0,0") +
        at("2", "400F00", 5, ",,12,80,51.2,7.001,,,,,,-1"));
    REQUIRE(messages.aircraft.size() == 2);
    CHECK_THAT(notes_in(messages), Contains("2 without time, place or height"));
    CHECK(messages.aircraft[0].heights == HeightKind::Pressure);
    const TrackedAircraft& first = messages.aircraft[messages.aircraft[0].id == "4CA2D6" ? 0 : 1];
    CHECK(first.call_sign == "RYR1");
    CHECK(first.samples[0].ground_speed_mps == Approx(mps_from_kt(400.0)));
    CHECK(first.samples[0].velocity_mps.z == Approx(-m_from_ft(10.0)));
    const TrackedAircraft& other = messages.aircraft[messages.aircraft[0].id == "4CA2D6" ? 1 : 0];
    CHECK(other.samples[1].contact == GroundContact::OnGround);
    CHECK(other.samples[1].position_m.z == Approx(m_from_ft(900.0)));
}

TEST_CASE("ArduPilot's logs are read by the formats that they describe, binary and as text") {
    const auto format = [](char kind, int length, const char* name, const char* types, const char* columns) {
        return std::string("\xA3\x95\x80") + kind + static_cast<char>(length) + zero_filled(name, 4) +
               zero_filled(types, 16) + zero_filled(columns, 64);
    };
    std::string log = format('\x01', 27, "POS", "QLLff", "TimeUS,Lat,Lng,Alt,RelHomeAlt") +
                      format('\x02', 17, "ATT", "Qccc", "TimeUS,Roll,Pitch,Yaw") + "junk";
    std::string text = "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\nFMT, 1, 27, POS, QLLff, "
                       "TimeUS,Lat,Lng,Alt,RelHomeAlt\nFMT, 2, 17, ATT, Qccc, TimeUS,Roll,Pitch,Yaw\n";
    for (std::uint64_t i = 0; i < 3; ++i) {
        const std::uint64_t us = 1000000 + 200000 * i;
        const auto latitude = static_cast<std::int32_t>(470000000 + 1000 * i);
        log += std::string("\xA3\x95\x02") + raw(us - 50000) + raw(std::int16_t(1000)) + raw(std::int16_t(200)) +
               raw(std::int16_t(static_cast<std::int16_t>(-100)));
        log += std::string("\xA3\x95\x01") + raw(us) + raw(latitude) + raw(std::int32_t(80000000)) + raw(500.5F) +
               raw(9.0F);
        text += fmt::format(
            "ATT, {}, 10.00, 2.00, -1.00\nPOS, {}, {:.7f}, 8.0000000, 500.50, 9.00\n", us - 50000, us, latitude * 1e-7);
    }
    for (const std::string& bytes : {log, text}) {
        const TrackRecording recording = recorded(bytes);
        const auto& samples = recording.aircraft[0].samples;
        REQUIRE(samples.size() == 3);
        CHECK(samples[2].time_s == Approx(0.4));
        CHECK(samples[2].position_m.y == Approx(22.2).margin(0.1));
        CHECK(samples[2].position_m.z == Approx(500.5));
        CHECK(samples[1].roll_rad == Approx(rad_from_deg(10.0)));
        CHECK(samples[1].heading_rad == Approx(rad_from_deg(-1.0)).margin(1e-6));
        CHECK(std::isnan(samples[2].roll_rad)); // no attitude follows
    }
    CHECK_THAT(notes_in(recorded(log)), Contains("left out 4 bytes between the messages"));
    CHECK_THROWS_WITH(
        recorded(log.substr(0, 178)), "track: expected places on the earth (POS or GPS messages with a fix), got none");
}

TEST_CASE("magnetic headings become true by how the way over the ground differs from them") {
    std::string text = "time,lat,lon,alt_m,pitch,roll,magnetic heading\n";
    for (int i = 0; i < 40; ++i) { text += fmt::format("{},{:.6f},8,500,1,0,345\n", i, 47.0 + 0.0005 * i); }
    const TrackRecording recording = recorded(text);
    CHECK_THAT(notes_in(recording), Contains("headings are magnetic: turned by 15.0 degrees east"));
    CHECK(std::abs(std::remainder(recording.aircraft[0].samples[9].heading_rad, 2.0 * pi)) < 1e-3);
}

TEST_CASE("heights of the atmosphere stand in where few others are, and speeds find their unit") {
    std::string text = "time,icao24,lat,lon,velocity,onground,baroaltitude,geoaltitude\n";
    for (int i = 0; i < 10; ++i) {
        text += fmt::format("{},abc123,{:.5f},8,100,False,900,{}\n", 10 * i, 47.0 + 0.0045 * i, i == 3 ? "950" : "");
    }
    const TrackRecording recording = recorded(text);
    CHECK(recording.aircraft[0].heights == HeightKind::Pressure);
    CHECK(recording.aircraft[0].samples.size() == 10);
    CHECK(recording.aircraft[0].samples[3].position_m.z == 900.0);
    CHECK(recording.aircraft[0].samples[3].ground_speed_mps == Approx(mps_from_kt(100.0))); // 50 m/s by the way
    CHECK(recording.aircraft[0].samples[3].contact == GroundContact::InAir);
}

TEST_CASE("a first fix far away does not make jumps of all others") {
    const TrackRecording recording =
        recorded("time,lat,lon,alt_m\n0,1,1,500\n1,47,8,500\n2,47.001,8,500\n3,47.002,8,500\n");
    CHECK(recording.aircraft[0].samples.size() == 3);
    CHECK(recording.origin->latitude_deg == 47.0);
}

TEST_CASE("a table of several aircraft is read as it was written, by name") {
    const auto path = [](double north_m, double from_s) {
        return sim::Trajectory(
            {{from_s, {100, north_m, 150}, {0, 250, 0}, body_to_world_from_euler({0, 0.1, -0.5}), 1.0},
                {from_s + 1.0, {100, north_m + 250, 150}, {0, 250, 0}, body_to_world_from_euler({0, 0, 0}), 1.5}});
    };
    const sim::Trajectory first = path(0.0, 0.0);
    const sim::Trajectory second = path(900.0, 0.5);
    const std::vector<WrittenTrack> others{{&second, nullptr, "two, \"2\""}};
    const std::string text = track_csv(first, "ONE", others);
    CHECK_THAT(text, Contains(",v_up_mps,aircraft\n0.000000,0.0000,100.0000"));
    const TrackRecording read = recorded(text);
    REQUIRE(read.aircraft.size() == 2);
    CHECK(read.aircraft[0].call_sign == "ONE");
    CHECK(read.aircraft[1].samples[1].time_s == 1.5);
    CHECK(read.aircraft[1].samples[1].position_m.y == Approx(1150.0));
    CHECK(recorded(text, "two").aircraft[0].samples[0].position_m.y == Approx(900.0));
    AcmiHeader header;
    header.call_sign = "ONE";
    header.others = others;
    const TrackRecording tape = recorded(track_acmi(first, header));
    REQUIRE(tape.aircraft.size() == 2);
    CHECK(tape.aircraft[0].call_sign == "ONE");
    CHECK(tape.aircraft[1].samples.size() == 2);
}

TEST_CASE("text in UTF-16 is read, binary data of no format are refused") {
    const std::string plain = "time,lat,lon,alt_m\n0,47,8,500\n1,47.001,8,500\n";
    std::string wide = "\xFF\xFE";
    for (const char c : plain) { wide += std::string{c, '\0'}; }
    CHECK(recorded(wide).aircraft[0].samples.size() == 2);
    CHECK_THROWS_WITH(recorded("time,lat" + std::string(3, '\0') + "x"),
        "track: expected text or a known format of flight recordings, got binary data");
    CHECK_THROWS_WITH(recorded(std::string("\x89PNG\r\n\x1A\n\0\0", 10)),
        "track: expected text or a known format of flight recordings, got a PNG picture");
}
