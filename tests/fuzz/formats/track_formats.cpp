// Recorded tracks of the formats that are no tables.
#include "flightpaths/recorded_track.h"
#include "flightpaths/track_motion.h"
#include "flightpaths/track_recording.h"
#include "sim/base/text_file.h"
#include "tests/fuzz/formats/target.h"
#include "tests/sim/links/mavlink_frames.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace octant::tests::formats {

namespace {

/// Reads a recording and makes the motion of each of its aircraft.
void use_recording(const std::filesystem::path& file) {
    const flightpaths::TrackRecording recording = flightpaths::parse_track_recording(read_file(file), file);
    expect(!recording.aircraft.empty(), "an aircraft");
    expect(recording.aircraft.size() <= flightpaths::max_recorded_aircraft, "no more than so many");
    expect(!recording.origin || std::isfinite(recording.origin->latitude_deg), "an origin");
    for (const flightpaths::TrackedAircraft& aircraft : recording.aircraft) {
        expect(aircraft.samples.size() >= 2, "two samples");
        for (std::size_t i = 1; i < aircraft.samples.size(); ++i) {
            expect(aircraft.samples[i].time_s > aircraft.samples[i - 1].time_s, "times that increase");
        }
        const sim::Trajectory motion = flightpaths::motion_of(aircraft).trajectory;
        for (const sim::AircraftState& state : motion.samples()) {
            expect(std::isfinite(state.time_s), "a time");
            for (int part = 0; part < 3; ++part) {
                expect(std::isfinite(state.position_m[part]), "a place");
                expect(std::isfinite(state.velocity_mps[part]), "a velocity");
            }
            expect(std::abs(glm::length(state.body_to_world) - 1.0) < 1e-6, "a unit attitude");
        }
    }
}

namespace acmi {

constexpr const char* all_forms = "\xef\xbb\xbf"
                                  R"(FileType=text/acmi/tacview
FileVersion=2.2
0,ReferenceTime=2026-01-01T00:00:00Z,ReferenceLongitude=120,ReferenceLatitude=35
0,Title=one\, two
// a remark
#0.00
1,T=7.1|2.5|150|1.2|-3|88,Type=Air+FixedWing,Name=F-15C,Color=Blue
2,T=7.2|2.5|150,Type=Air+Rotorcraft,Name=OH\-6
3,T=7.2|2.6|20|-1000|2000,Type=Sea+Watercraft
a4,T=7.2|2.6|900|0|0|10|-1000|2000|10,Name=broken \
over two lines
#0.50
1,T=|2.5001||||
2,T=7.2001||
a4,T=|2.6001|||||||
#1.00
1,T=|2.5002|||2|
2,T=7.2002||
-a4
0,Event=Bookmark|1|pull-down
#0.75
2,T=7.20015||
)";

constexpr const char* without_attitude = R"(FileType=text/acmi/tacview
FileVersion=2.1
#10
1,T=8|47|900
#11
1,T=8|47.001|900
#12
1,T=8|47.002|901
-1
#13
1,T=8|47.1|900,Type=Air
#14
1,T=8|47.101|900
)";

const Registered target({
    .name = "acmi",
    .file = "input.acmi",
    .use = use_recording,
    .seeds =
        [] {
            return std::vector<std::string>{all_forms, without_attitude};
        },
    .words = {"#", "-", "T=", "|", "||", "|||||||", ",", "\\,", "\\\n", "//", "0,", "1,", "ffffffffffffffff,",
        "Type=Air+FixedWing", "Type=Weapon+Missile",
        "Name=", "ReferenceLongitude=", "ReferenceLatitude=", "FileVersion=2.", "1e300", "nan", "-90"},
});

} // namespace acmi

namespace basestation {

const Registered target({
    .name = "basestation",
    .file = "input.csv",
    .use = use_recording,
    .seeds =
        [] {
            return std::vector<std::string>{
                "connected\n"
                "MSG,1,1,1,4CA2D6,1,2016/03/11,13:07:15.000,2016/03/11,13:07:15.000,RYR1,,,,,,,,,,,0\n"
                "MSG,4,1,1,4CA2D6,1,2016/03/11,13:07:16.000,2016/03/11,13:07:16.000,,,420,90,,,-640,,,,,0\n"
                "MSG,3,1,1,4CA2D6,1,2016/03/11,13:07:16.100,2016/03/11,13:07:16.000,,36000,,,51.1,7.1,,,0,,0,0\n"
                "MSG,3,1,1,4CA2D6,1,2016/03/11,13:07:17.100,2016/03/11,13:07:17.000,,36000,,,51.1,7.103,,,0,,0,0\n"
                "MSG,2,1,1,400F00,1,2016/03/11,13:07:17.000,2016/03/11,13:07:17.000,,,12,80,51.2,7.2,,,,,,-1\n"
                "MSG,3,1,1,400F00,1,2016/03/11,13:07:19.000,2016/03/11,13:07:17.000,,300,,,51.2,7.2002,,,,,,0\n"};
        },
    .words = {"MSG,", "MSG,3,", ",,", "-1", "2016/03/11", "13:07:17", "\r\n", "1e300", "nan"},
});

} // namespace basestation

template <class Number>
std::string bytes_of(Number number) {
    std::string bytes(sizeof(number), '\0');
    std::memcpy(bytes.data(), &number, sizeof(number));
    return bytes;
}

namespace dataflash {

std::string padded(std::string text, std::size_t size) {
    text.resize(size, '\0');
    return text;
}

std::string message(char kind, const std::string& payload) { return std::string("\xA3\x95") + kind + payload; }

std::string format(
    char kind, std::uint8_t length, const std::string& name, const std::string& types, const std::string& columns) {
    return message('\x80',
        std::string(1, kind) + static_cast<char>(length) + padded(name, 4) + padded(types, 16) + padded(columns, 64));
}

std::vector<std::string> seeds() {
    std::string log =
        format('\x80', 89, "FMT", "BBnNZ", "Type,Length,Name,Format,Columns") +
        format('\x01', 27, "POS", "QLLff", "TimeUS,Lat,Lng,Alt,RelHomeAlt") +
        format('\x02', 17, "ATT", "Qccc", "TimeUS,Roll,Pitch,Yaw") + format('\x03', 75, "MSG", "QZ", "TimeUS,Message") +
        format('\x04', 46, "GPS", "QBIHBcLLefffB", "TimeUS,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ,U");
    log += message('\x03', bytes_of(std::uint64_t{1000}) + padded("ArduCopter V4.0", 64));
    for (std::uint64_t i = 1; i < 5; ++i) {
        const std::string time = bytes_of(i * 200000);
        const std::string place =
            bytes_of(static_cast<std::int32_t>(473000000 + 100 * i)) + bytes_of(std::int32_t{80000000});
        log += message(
            '\x02', time + bytes_of(std::int16_t{100}) + bytes_of(std::int16_t{-200}) + bytes_of(std::int16_t{9000}));
        log += message('\x04', time + "\x03" + bytes_of(std::uint32_t{1000}) + bytes_of(std::uint16_t{2000}) + "\x09" +
                                   bytes_of(std::int16_t{80}) + place + bytes_of(std::int32_t{50000}) +
                                   bytes_of(10.0F) + bytes_of(20.0F) + bytes_of(-1.0F) + "\x01");
        log += message('\x01', time + place + bytes_of(500.0F) + bytes_of(10.0F));
    }
    return {log, log + "\x01\x02" + log.substr(log.size() - 27)};
}

const Registered target({.name = "dataflash",
    .file = "input.bin",
    .use = use_recording,
    .seeds = seeds,
    .words = {"\xA3\x95", "POS", "GPS", "ATT", "QLLff", "Lat", "Lng", "Z", "a"}});

} // namespace dataflash

namespace dataflash_text {

const Registered target({
    .name = "dataflash_text",
    .file = "input.log",
    .use = use_recording,
    .seeds =
        [] {
            return std::vector<std::string>{
                "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\n"
                "FMT, 130, 45, GPS, BIHBcLLeeEefI, Status,TimeMS,Week,NSats,HDop,Lat,Lng,RelAlt,Alt,Spd,GCrs,VZ,T\n"
                "FMT, 1, 17, ATT, Iccc, TimeMS,Roll,Pitch,Yaw\nMSG, ArduPlane V2.7\n"
                "ATT, 900, 1.00, -2.0, 90\nGPS, 3, 4000, 1800, 9, 1.2, 47.1, 8.1, 0.1, 500.2, 12.1, 90.2, -0.1, 1000\n"
                "ATT, 1100, 1.00, -2.0, 90\nGPS, 3, 4200, 1800, 9, 1.2, 47.1, 8.10001, 0.1, 500.2, 12.1, 90.2, -0.1, "
                "1200\n"};
        },
    .words = {"FMT, ", "GPS, ", "POS, ", "ATT, ", "Lat", "Lng", "TimeUS", ", ", "\r\n", "1e300", "nan"},
});

} // namespace dataflash_text

namespace gpx {

const Registered target({
    .name = "gpx",
    .file = "input.gpx",
    .use = use_recording,
    .seeds =
        [] {
            return std::vector<std::string>{
                "<?xml version=\"1.0\"?>\n<gpx><!-- a --><trk><name>A</name><trkseg><trkpt lat=\"47\" "
                "lon=\"8\"><ele>500</ele>"
                "<time>2024-01-02T23:59:58Z</time></trkpt>\n<trkpt lon='8.0' lat='47.001'><time>2024-01-02T"
                "23:59:59Z</time><ele>500.0</ele><extensions><x:speed>3</x:speed></extensions></trkpt></trkseg></trk>"
                "<trk><name>B</name><trkseg><trkpt lat=\"47\" lon=\"8\"><time>2024-01-02T23:59:58.5Z</time></trkpt>"
                "<trkpt lat=\"47\" "
                "lon=\"8\"><ele>1</ele><time>2024-01-02T23:59:59.5Z</time></trkpt></trkseg></trk></gpx>\n"};
        },
    .words = {"<trkpt ", "</trkpt>", "<trk>", "<name>", "<ele>", "<time>", "lat=\"", "lon=\"", "<![CDATA[", "]]>",
        "&#0;", "<!--", "-->", "2024-01-02"},
});

} // namespace gpx

namespace igc {

const Registered target({
    .name = "igc",
    .file = "input.igc",
    .use = use_recording,
    .seeds =
        [] {
            return std::vector<std::string>{
                "AXCS123\r\nHFDTE160701\r\nHFGTYGLIDERTYPE:LS 8\r\nB2359584700000N00800000EA0048000500120\r\n"
                "B2359594700060N00800000EV0048000500120\r\nB2359604700060N00800000EV0048000500120\r\nB0000004700120N008"
                "00000EA-048000500120\r\n"};
        },
    .words = {"B235959", "HFDTE", "HFDTEDATE:160701,01", "N", "W", "A", "V", "\r\n"},
});

} // namespace igc

namespace kml {

const Registered target({
    .name = "kml",
    .file = "input.kml",
    .use = use_recording,
    .seeds =
        [] {
            return std::vector<std::string>{
                "<kml "
                "xmlns:gx='g'><Document><Placemark><name>A</name><gx:MultiTrack><gx:Track><altitudeMode>absolute</"
                "altitudeMode>"
                "<when>2024-01-02T23:59:58Z</when><when>2024-01-02T23:59:59Z</when><gx:coord>8 47 500</gx:coord>"
                "<gx:coord>8 47.001 500</gx:coord><gx:angles>9 1 2</gx:angles><gx:angles>9 1 "
                "2</gx:angles></gx:Track></gx:MultiTrack></Placemark></Document></kml>",
                "<kml><Placemark><LineString><altitudeMode>relativeToGround</altitudeMode><coordinates>8,47,5 "
                "8.001,47\n8.002,47,6</coordinates></LineString></Placemark></kml>",
                "<kml><Placemark><TimeStamp><when>2024-01-02T23:59:58Z</when></TimeStamp><Point><coordinates>8,47,5</"
                "coordinates></Point></Placemark>"
                "<Placemark><TimeStamp><when>2024-01-03</when></TimeStamp><Point><coordinates>8,47.1,5</coordinates></"
                "Point></Placemark>"
                "<Placemark><TimeStamp><when>2024-01-03T00:00:10Z</when></TimeStamp><Point><coordinates>8,47.1,5</"
                "coordinates></Point></Placemark></kml>"};
        },
    .words = {"<gx:Track>", "<when>", "<gx:coord>", "<LineString>", "<coordinates>", "<Placemark>", "</", "8,47",
        "1e300", "nan", "<![CDATA["},
});

} // namespace kml

namespace mavlink_log {

std::vector<std::string> seeds() {
    namespace links = sim::links;
    std::string log;
    for (int i = 0; i < 6; ++i) {
        const std::uint64_t us =
            std::uint64_t{1500000000000000} + static_cast<std::uint64_t>(i) * std::uint64_t{250000};
        for (int byte = 7; byte >= 0; --byte) {
            log += static_cast<char>(us >> static_cast<unsigned>(8 * byte) & 0xFFU);
        }
        links::MavLinkFrame frame{
            i % 2 == 0 ? links::MavLinkKind::GlobalPositionInt : links::MavLinkKind::Attitude, 1, {}};
        frame.payload.resize(28, std::byte{0});
        const auto put = [&](std::size_t at, std::int32_t value) { std::memcpy(frame.payload.data() + at, &value, 4); };
        put(0, 1000 + 250 * i);
        if (i % 2 == 0) {
            put(4, 473000000 + 100 * i);
            put(8, 80000000);
            put(12, 500000);
        }
        const auto bytes = tests::encode_mavlink(frame, static_cast<std::uint8_t>(i));
        log.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    return {log, log.substr(0, 60) + "junk" + log};
}

const Registered target(
    {.name = "mavlink_log", .file = "input.tlog", .use = use_recording, .seeds = seeds, .words = {"\xFE", "\xFD"}});

} // namespace mavlink_log

namespace readsb_trace {

const Registered target({
    .name = "readsb_trace",
    .file = "trace_full_abc.json",
    .use = use_recording,
    .seeds =
        [] {
            return std::vector<std::string>{
                R"({"icao":"abc123","t":"B739","timestamp":1738703622.6,"trace":[[0,47,8,"ground",12,90,0,0,null,"a",null,null,null,null],)"
                R"([9,47.001,8,1000,120,0,0,640,{"flight":"DAL1 "},"a",1100,640,110,1.5],[18,47.01,8,1100,120,0,0,null,null,"a",1200,0,null,null]]})"};
        },
    .words = {"null", "\"ground\"", "[", "]", "{}", "\"trace\":", "\"timestamp\":", "1e300", "-1"},
});

} // namespace readsb_trace

namespace ulog {

std::string message(char type, const std::string& payload) {
    return bytes_of(static_cast<std::uint16_t>(payload.size())) + type + payload;
}

std::vector<std::string> seeds() {
    std::string log("ULog\x01\x12\x35\x01", 8);
    log += bytes_of(std::uint64_t{1});
    log += message('F', "vehicle_global_position:uint64_t timestamp;double lat;double lon;float alt;");
    log += message('F', "vehicle_attitude:uint64_t timestamp;float[4] q;uint8_t[3] _padding0;");
    log += message('F', "vehicle_gps_position:uint64_t timestamp;uint64_t time_utc_usec;int32_t lat;int32_t "
                        "lon;int32_t alt;float vel_n_m_s;float vel_e_m_s;float vel_d_m_s;uint8_t fix_type;");
    log += message('A', std::string("\0\x01\0", 3) + "vehicle_global_position") +
           message('A', std::string("\0\x02\0", 3) + "vehicle_attitude") +
           message('A', std::string("\0\x03\0", 3) + "vehicle_gps_position");
    for (std::uint64_t i = 1; i < 4; ++i) {
        const std::string time = bytes_of(i * 100000);
        log += message(
            'D', std::string("\x02\0", 2) + time + bytes_of(1.0F) + bytes_of(0.0F) + bytes_of(0.0F) + bytes_of(0.0F));
        log += message('D', std::string("\x01\0", 2) + time + bytes_of(47.0 + 1e-6 * static_cast<double>(i)) +
                                bytes_of(8.0) + bytes_of(500.0F));
        log += message('D', std::string("\x03\0", 2) + time + bytes_of(std::uint64_t{1500000000000000}) +
                                bytes_of(std::int32_t{470000000}) + bytes_of(std::int32_t{80000000}) +
                                bytes_of(std::int32_t{500000}) + bytes_of(1.0F) + bytes_of(1.0F) + bytes_of(0.0F) +
                                "\x03");
    }
    return {log};
}

const Registered target({.name = "ulog",
    .file = "input.ulg",
    .use = use_recording,
    .seeds = seeds,
    .words = {"float[4] q;", "double lat;", "uint64_t timestamp;", "vehicle_attitude", "[", "];", ":"}});

} // namespace ulog

namespace xplane_tracks {

const Registered target({
    .name = "xplane_tracks",
    .file = "input.fdr",
    .use = use_recording,
    .seeds =
        [] {
            return std::vector<std::string>{
                "A\n4\n\nACFT, Aircraft/a/b.acf\nTAIL, N1\nDATE, 06/15/2019\nDREF, sim/x 1.0 // c\n"
                "10:00:00.5, 8.0, 47.0, 1000, 90, 2, 1\n10:00:01.5, 8.001, 47.0, 1000, 90, 2, 1, 5\n",
                "I\n1\nTIME,18:00:00,\nDATE,08/10/2004\nDATA,1.0,65,8.0,47.0,1000,0,0,0,0,2,1,90,100,0\n"
                "DATA,2.0,65,8.001,47.0,1000,0,0,0,0,2,1,90,100,0\n",
                "   _real,_time |   _totl,_time |   pitch,__deg |   _roll,__deg |   hding,_true |   __lat,__deg |   "
                "__lon,__deg |   __alt,ftmsl | \n"
                " 1.0 | 1.0 | 2.0 | 1.0 | 90.0 | 47.0 | 8.0 | 1000.0 | \n 2.0 | 2.0 | 2.0 | 1.0 | 90.0 | 47.0 | 8.001 "
                "| 1000.0 | \n"};
        },
    .words = {"DATA,", "DREF, ", "TIME,", "DATE,", "|", "_totl,_time", "//", ",", "\r\n", "1e300", "nan", "10:00:02"},
});

} // namespace xplane_tracks

} // namespace

} // namespace octant::tests::formats
