#include "flightpaths/log_columns.h"
#include "flightpaths/recorded_track.h"
#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "tests/flightpaths/track_fault.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace octant;
using namespace octant::flightpaths;
using Catch::Contains;
using octant::tests::track_fault;
using octant::tests::written;

namespace {

RecordedTrack log_of(const std::string& text) { return read_recorded_track(written("log.csv", text)); }

/// A thousandth of a degree on WGS 84 along the meridian at 47 degrees north.
constexpr double thousandth_north_m = 111.17;

void check_northward(const RecordedTrack& track, double first_m, double step_s) {
    REQUIRE(track.origin);
    CHECK(track.origin->latitude_deg == Approx(47.0));
    CHECK(track.origin->longitude_deg == Approx(8.0));
    REQUIRE(track.trajectory.samples().size() >= 3); // more where times are far apart
    CHECK(track.trajectory.start_s() == 0.0);
    CHECK(track.trajectory.end_s() == Approx(2.0 * step_s));
    for (int i = 0; i < 3; ++i) {
        INFO(i);
        const sim::AircraftState state = track.trajectory.state_at(step_s * i);
        CHECK(state.position_m.y == Approx(thousandth_north_m * i).margin(0.05));
        CHECK(state.position_m.z == Approx(first_m));
    }
}

} // namespace

TEST_CASE("moments are read as numbers, clocks and dates, and nothing else is") {
    CHECK(log_time("12.5")->seconds == 12.5);
    CHECK(log_time("07:41:03.5")->seconds == 7 * 3600 + 41 * 60 + 3.5);
    CHECK(log_time("07:41:03")->is_time_of_day);
    CHECK(log_time("1970-01-02T00:00:01Z")->seconds == 86401.0);
    CHECK_FALSE(log_time("1970-01-02T00:00:01Z")->is_time_of_day);
    CHECK(log_time("2024-01-02 07:41:03Z.515")->seconds == 1704181263.515);
    CHECK(log_time("2024/01/02 07:41:03+01:00")->seconds == 1704181263.0 - 3600.0);
    CHECK(log_time("07:41:03 PM")->seconds == 19 * 3600 + 41 * 60 + 3);
    CHECK(log_time("12:00:00am")->seconds == 0.0);
    CHECK(log_time("1/2/2024 12:41:03.5 PM")->seconds == 1704181263.5 + 5 * 3600);
    CHECK(log_time("1/2/2024 07:41:03")->day_is_guessed);
    CHECK(log_time("02.01.2024 07:41:03")->seconds == 1704181263.0);
    CHECK_FALSE(log_time("02.01.2024 07:41:03")->day_is_guessed);
    CHECK(log_date("31/1/2024")->seconds == log_date("2024-01-31")->seconds);
    CHECK(log_date("1/31/24")->seconds == log_date("20240131")->seconds);
    CHECK_FALSE(log_date("1/31/24")->day_is_guessed);
    for (const char* wrong : {"", "noon", "7:41", "25:00:00", "07:61:00", "2024-13-02T07:41:03", "2024-02-30 07:41:03",
             "2024-01-02", "13:41:03 PM", "0:41:03 AM", "07:41:03 XM", "13/13/2024 07:41:03", "31-02-24 07:41:03",
             "1:2:3:4", "99999-01-01T00:00:00", "2024-01-02T", "::"}) {
        INFO(wrong);
        CHECK_FALSE(log_time(wrong));
    }
}

TEST_CASE("a log of Flightradar24 has its place in one field and its heights in feet") {
    const RecordedTrack track = log_of("Timestamp,UTC,Callsign,Position,Altitude,Speed,Direction\n"
                                       "1704180175,2024-01-02T07:22:55Z,ABC1,\"47.0,8.0\",1000,0,73\n"
                                       "1704180177,2024-01-02T07:22:57Z,ABC1,\"47.001,8.0\",1000,144,172\n"
                                       "1704180179,2024-01-02T07:22:59Z,ABC1,\"47.002,8.0\",1000,140,171\n");
    check_northward(track, 304.8, 2.0);
    REQUIRE(track.notes.size() == 1);
    CHECK_THAT(track.notes[0], Contains("heading, pitch and roll are inferred from the motion"));
    CHECK(track.trajectory.samples()[1].velocity_mps.y == Approx(thousandth_north_m / 2).margin(0.1));
}

TEST_CASE("a log whose dates end with the year has a moment, and is told that its day is guessed") {
    const RecordedTrack track = log_of("Date,Time,lat,lon,alt_m\n"
                                       "03/05/2024,11:59:59 AM,47.0,8.0,300\n"
                                       "03/05/2024,12:00:01 PM,47.001,8.0,300\n"
                                       "03/05/2024,12:00:03 PM,47.002,8.0,300\n");
    check_northward(track, 300.0, 2.0);
    CHECK_THAT(track.notes,
        Catch::Matchers::VectorContains(std::string("dates are taken as month/day/year: line 2 has 03/05/2024")));
}

TEST_CASE("dates that do not exist are told, and the log is flown by its clock") {
    const RecordedTrack track = log_of("Date,Time,lat,lon,alt_m\n"
                                       "13/13/2024,10:00:00,47.0,8.0,300\n"
                                       "13/13/2024,10:00:02,47.001,8.0,300\n"
                                       "13/13/2024,10:00:04,47.002,8.0,300\n");
    check_northward(track, 300.0, 2.0);
    CHECK_THAT(track.notes,
        Catch::Matchers::VectorContains(std::string("left out 3 values of column Date that are no dates")));
}

TEST_CASE("a log of Garmin's has comments and units above its names, and clocks past midnight") {
    const RecordedTrack track =
        log_of("#airframe_info, log_version=\"1.00\"\n"
               "#yyy-mm-dd, hh:mm:ss,   hh:mm,  ident,  degrees, degrees, ft Baro, ft msl, deg, deg, deg\n"
               "  Lcl Date, Lcl Time, UTCOfst, AtvWpt, Latitude, Longitude, AltB, AltMSL, Pitch, Roll, "
               "HDG\n"
               "2021-06-13, 23:59:58,  03:00,       ,         ,          ,     ,       ,      ,     , \n"
               "2021-06-13, 23:59:59,  03:00,       ,  47.0000,  8.0000,   900,   1000,   4.0, -20.0, 77\n"
               "2021-06-14, 00:00:00,  03:00,       ,  47.0010,  8.0000,   900,   1000,   4.0, -20.0, 77\n"
               "2021-06-14, 00:00:00,  03:00,       ,  47.0010,  8.0000,   900,   1000,   4.0, -20.0, 77\n"
               "2021-06-14, 00:00:01,  03:00,       ,  47.0020,  8.0000,   900,   1000,   4.0, -20.0, "
               "77\n");
    const auto samples = track.trajectory.samples();
    REQUIRE(samples.size() == 3);
    CHECK(samples[2].time_s - samples[0].time_s == Approx(2.0));
    CHECK(samples[0].position_m.z == Approx(304.8));
    const EulerAngles angles = euler_from_body_to_world(samples[1].body_to_world);
    CHECK(angles.roll_rad == Approx(rad_from_deg(-20.0)));
    CHECK(angles.pitch_rad == Approx(rad_from_deg(4.0)));
    CHECK(angles.heading_rad == Approx(0.0).margin(1e-6)); // of the motion, not of the compass
    REQUIRE(track.notes.size() == 3);
    CHECK_THAT(track.notes[0], Contains("headings are magnetic and too few"));
    CHECK_THAT(track.notes[1], Contains("1 without time, place or height, 1 of a moment that had been"));
    CHECK_THAT(track.notes[2], Contains("heading is inferred from the motion"));
}

TEST_CASE("a log of FlySight has its units below its names, and velocities") {
    const std::string text = "time,lat,lon,hMSL,velN,velE,velD,hAcc,numSV\n"
                             ",(deg),(deg),(m),(m/s),(m/s),(m/s),(m),\n"
                             "2018-08-12T14:25:43.00Z,47,8,500,11,22,-3,24.7,6\n"
                             "2018-08-12T14:25:43.20Z,47.001,8,500,11,22,-3,24.7,6\n"
                             "2018-08-12T14:25:43.40Z,47.002,8,500,11,22,-3,24.7,6\n";
    check_northward(log_of(text), 500.0, 0.2);
    // Velocities that contradict the places are read, and not flown.
    const TrackRecording recording = parse_track_recording(text, "log.csv");
    CHECK(glm::length(recording.aircraft[0].samples[1].velocity_mps - glm::dvec3(22, 11, 3)) < 1e-3);
}

TEST_CASE("units stand in names, and times since 1970 may be in thousandths") {
    check_northward(log_of("time(millisecond),latitude,longitude,altitude_above_seaLevel(feet)\n"
                           "0,47,8,1000\n500,47.001,8,1000\n1000,47.002,8,1000\n"),
        304.8, 0.5);
    check_northward(log_of("TIMESTAMP;LAT;LON;ALT_FT\n1704180175000;47;8;1000\n1704180175500;47.001;8;1000\n"
                           "1704180176000;47.002;8;1000\n"),
        304.8, 0.5);
    const RecordedTrack unnamed = log_of("t_s,lat,lng,alt\n5,47,8,700\n6,47.001,8,700\n7,47.002,8,700\n");
    check_northward(unnamed, 700.0, 1.0);
    REQUIRE(unnamed.notes.size() == 2);
    CHECK_THAT(unnamed.notes[0], Contains("alt names no unit: its heights are taken as metres"));
}

TEST_CASE("true headings, pitch and roll of a log are taken as they are") {
    const RecordedTrack track =
        log_of("time,lat,lon,alt_m,heading,pitch,roll\n0,47,8,500,90,2,10\n1,47.001,8,500,91,2,10\n");
    const EulerAngles angles = euler_from_body_to_world(track.trajectory.samples()[0].body_to_world);
    CHECK(angles.heading_rad == Approx(rad_from_deg(90.0)));
    CHECK(angles.roll_rad == Approx(rad_from_deg(10.0)));
}

TEST_CASE("columns of ours and of JSBSim are found in capitals, below comments and empty lines") {
    const RecordedTrack own = log_of("\n# flown in May\nT_S,NORTH_M,EAST_M,ALT_M\n0,0,0,100\n"
                                     "# half way\n1,50,0,100\n");
    CHECK(own.trajectory.samples().size() == 2);
    CHECK_FALSE(own.origin);
}

TEST_CASE("what no log of a flight may hold is refused with its line") {
    const std::string head = "time,lat,lon,alt_m\n";
    CHECK(track_fault(head + "0,47,8,500\n1,x,8,500\n") == "3: expected a finite number in column lat, got 'x'");
    CHECK(track_fault(head + "0,47,8,500\nnoon,47,8,500\n") ==
          "3: expected a time such as 12.5, 07:41:03 or 2024-01-02T07:41:03Z in column time, got 'noon'");
    CHECK(track_fault(head + "0,97,8,500\n") ==
          "2: expected a latitude within 90 deg and a longitude within 360 deg, got 97 and 8");
    CHECK(track_fault(head + "0,47,8,500\n90000,47,8,500\n") == " expected at least 2 samples with a place, got 2");
    CHECK(track_fault("time,lat,place\n0,47,8\n") ==
          "1: expected column names with a time and a place among them (t_s, north_m, east_m, alt_m or Time, Latitude, "
          "Longitude, Altitude), or a file of a known format, got time,lat,place");
    CHECK(track_fault(head + "0,,,\n") ==
          " expected at least 2 samples with a place, got 0; left out of the log: 1 without time, "
          "place or height, 0 of a moment that had been, 0 that only a jump leads to");
    CHECK(track_fault(head + "0,47,8,500\n") == " expected at least 2 samples with a place, got 1");
    CHECK(track_fault(head + "0,47,8,1e9\n1,47,8,0\n") == "2: expected a height within 10000 km, got 1000000 km");
    CHECK(track_fault(head + "0,47,8,500\n1,57,8,500\n2,47.001,8,500\n") == "no error"); // a jump
}

TEST_CASE("every cut of a good log is read or refused, never worse") {
    const std::string good = "Timestamp,UTC,Callsign,Position,Altitude\n"
                             "1704180175,2024-01-02T07:22:55Z,ABC1,\"47.0,8.0\",1000\n"
                             "1704180177,2024-01-02T07:22:57Z,ABC1,\"47.001,8.0\",1000";
    for (std::size_t length = 0; length < good.size(); ++length) {
        const std::string fault = track_fault(good.substr(0, length));
        CHECK(fault.find('\n') == std::string::npos);
    }
}

TEST_CASE("a flight recorder's fixes are read, by the receiver's heights where most have one") {
    const std::string head = "AXCS123\r\nHFDTE160701\r\nHFPLTPILOT:B\xfc"
                             "rg\r\nI013638TAS\r\n";
    const auto igc = [&](const std::string& fixes) { return read_recorded_track(written("flight.igc", head + fixes)); };
    check_northward(igc("B2359584700000N00800000EA0048000500120\r\n"
                        "LXCS a note\r\n"
                        "B2359594700060N00800000EA0048000500120\r\n"
                        "B0000004700120N00800000EA0048000500120\r\n"),
        500.0, 1.0);
    const RecordedTrack by_pressure =
        igc("B1000004700000N00800000EV-001200000\nB1000044700060N00800000EV-001200000\n"
            "B1000084700120N00800000EA-001200000\nB10\nB100012470012\xc3N00800000EA-001200000\n");
    check_northward(by_pressure, -12.0, 4.0);
    REQUIRE(by_pressure.notes.size() == 3);
    CHECK_THAT(by_pressure.notes[0], Contains("pressure altitudes"));
    CHECK_THAT(by_pressure.notes[1], Contains("2 without time, place or height"));
    const RecordedTrack south_west = igc("B1000003330000S07030500WA0050000500\nB1000013330000S07030500WA0050000500\n");
    CHECK(south_west.origin->latitude_deg == Approx(-33.5));
    CHECK(south_west.origin->longitude_deg == Approx(-70.0 - 30.5 / 60.0));
    CHECK_THROWS_WITH(igc("B1000004700000N00800000EA0048000500\n"),
        Contains("flight.igc: expected at least 2 samples with a place, got 1"));
}

TEST_CASE("the track points of GPX are read, of all segments, and nothing else of it") {
    const std::string head = "\xef\xbb\xbf<?xml version=\"1.0\"?>\n<gpx version='1.1'>\n"
                             "<wpt lat=\"1\" lon=\"1\"><ele>1</ele><time>2020-01-01T00:00:00Z</time>"
                             "</wpt><!-- <trkpt lat='9' lon='9'> -->\n<trk><trkseg>\n";
    const auto gpx = [&](const std::string& points) {
        return read_recorded_track(written("flight.gpx", head + points + "</trkseg></trk></gpx>"));
    };
    const std::string first = "<trkpt lat=\"47\" lon=\"8\"><ele>500</ele><time>2024-01-02T23:59:58Z</time></trkpt>";
    check_northward(gpx(first + "</trkseg><trkseg><trkpt lon='8.0'\n lat='47.001'><time>2024-01-02T23:59:58.5Z"
                                "</time><ele> 500.0 </ele></trkpt>\n<trkpt lat='47.0015' lon='8'/>"
                                "<trkpt lat=\"47.002\" lon=\"8\"><ele>500</ele><time>2024-01-02T23:59:59Z</time>"
                                "<extensions><speed>3</speed></extensions></trkpt>"),
        500.0, 0.5);
    CHECK_THROWS_WITH(gpx("<rtept lat='1' lon='1'/>"), Contains("flight.gpx: expected track points"));
    CHECK_THROWS_WITH(gpx("\n<trkpt lat='1' lon='1'>"), Contains("flight.gpx:6: expected well-formed XML"));
    CHECK_THROWS_WITH(gpx(first + "\n<trkpt lat='97' lon='8'><ele>5</ele><time>2024-01-03T00:00:00Z</time></trkpt>"),
        Contains("flight.gpx:6: expected a latitude within 90 deg"));
}
