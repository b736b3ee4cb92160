// Paths, tracks, recordings, and the files of settings.
#include "flightpaths/fly_script.h"
#include "flightpaths/recorded_track.h"
#include "flightpaths/track_writer.h"
#include "sim/aircraft_kind.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/fuzz/formats/target.h"
#include "ui/report/frame_capture.h"
#include "ui/report/frame_csv.h"
#include "ui/report/run_file.h"
#include "ui/report/statistics.h"
#include "ui/settings/settings_file.h"
#include "ui/sweep/sweep_file.h"
#include "ui/window/key_map.h"
#include "ui/window/panel_columns.h"
#include "ui/world/entity_table.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace octant::tests::formats {

namespace {

namespace entity_table {

void use(const std::filesystem::path& file) {
    const ui::world::EntityTable table = ui::world::read_entity_table(file);
    expect(!table.aircraft.empty() && table.aircraft.size() <= 256, "some aircraft");
    for (const auto& [type, aircraft] : table.types) {
        expect(aircraft < table.aircraft.size(), "an aircraft for each type");
    }
}

const Registered target({
    .name = "entity_table",
    .file = "input.toml",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{
                "[[entity]]\ntype = 1\naircraft = \"f15\"\n[[entity]]\ntype = 9\naircraft = "
                "\"my-helicopter.obj\"\ncount = 4\n"};
        },
    .words = {"[[entity]]\n", "[entity]\n", "type = ", "aircraft = ", "count = ", "65535", "256", "\"\"", "[1]", "inf",
        "true"},
});

} // namespace entity_table

namespace frame_capture {

void use(const std::filesystem::path& file) {
    const ui::report::FrameCapture capture = ui::report::read_frame_capture(file);
    expect(!capture.frames.empty() && !capture.run.title.empty(), "a title and frames");
    double before_s = 0.0;
    for (const ui::report::FrameTime& frame : capture.frames) {
        expect(frame.frame_ms > 0.0 && frame.frame_ms <= 1e9, "a frame time");
        expect(frame.time_s >= before_s && std::isfinite(frame.time_s), "a time");
        before_s = frame.time_s;
    }
}

std::vector<std::string> seeds() {
    return {"Application,ProcessID,SwapChainAddress,Runtime,Dropped,TimeInSeconds,msBetweenPresents,Processor\n"
            "a.exe,1,0x1,DXGI,0,1.5,16.5,A CPU\nb.exe,2,0x2,DXGI,0,1.6,8.25\na.exe,1,0x1,DXGI,1,1.7,20\n",
        "\xef\xbb\xbf"
        "Application,FrameType,CPUStartTime,FrameTime,DisplayedTime\r\na.exe,Application,0,9,NA\r\n"
        "a.exe,AMD AFMF,0,9,1\r\na.exe,Application,9,NA,9\r\n",
        "//GameName=a\n//GPU=b\nApplication;TimeInMs;MsBetweenPresents\na.exe;1,5;16,5\na.exe;18,5;17\n",
        "v1\n0.7.1\n---SYSTEM INFO---\nos,cpu,gpu\na,b,c\n---FRAME METRICS---\nfps,frametime,elapsed\n"
        "60,16500,1000\n50,20000,20001000\n",
        R"({"Info":{"GameName":"a","GPU":"b","GPUCount":null},"Runs":[{"CaptureData":{"TimeInSeconds":[0,0.02],)"
        R"("MsBetweenPresents":[16.5,20],"Dropped":[false,true]}},{"CaptureData":{"MsBetweenPresents":[9]}}]})"};
}

const Registered target({
    .name = "frame_capture",
    .file = "capture",
    .use = use,
    .seeds = seeds,
    .words = {"Application,", "ProcessID,", "FrameType,", "FrameTime,", "MsBetweenPresents,", "TimeInSeconds,",
        "CPUBusy,", "CPUWait,", "fps,", "frametime,", "elapsed,", "NA", "nan", ";", "\t", "//", "0,5", "1e9", "-1",
        "null", "\"Runs\":", "\"CaptureData\":", "\"Info\":", "\xff\xfe"},
});

} // namespace frame_capture

namespace frames {

/// Computes the figures of a report, and writes the rows.
void use(const std::filesystem::path& file) {
    const ui::report::FrameFile read = ui::report::read_frame_csv(file);
    const ui::report::Statistics statistics = ui::report::statistics_of(read.records);
    expect(statistics.frames <= static_cast<int>(read.records.size()), "no more frames than rows");
    for (const ui::report::FrameRecord& record : read.records) {
        expect(ui::report::frame_csv_line(record).ends_with('\n'), "a line");
    }
}

std::vector<std::string> seeds() {
    std::string text = ui::report::frame_csv_header();
    std::vector<std::string> all{text};
    for (int frame = 0; frame < 5; ++frame) {
        ui::report::FrameRecord record;
        record.frame = frame;
        record.warm_up = frame < 2;
        record.sim_time_s = frame / 60.0;
        record.frame_ms = 10.0 + 5.0 * frame;
        record.terrain_triangles = 5000;
        record.stress = 0.9;
        text += ui::report::frame_csv_line(record);
    }
    all.push_back(text);
    all.push_back(text.substr(0, text.size() - 20));
    return all;
}

const Registered target({
    .name = "frames",
    .file = "frames.csv",
    .use = use,
    .seeds = seeds,
    .words = {"frame,", "warm_up,", "overrun,", ",,", "\r\n", "-1,", "2147483647"},
});

} // namespace frames

namespace path_script {

constexpr int max_steps = 20000;

/// Flies it where that does not take long, within limits and with legs clipped.
void use(const std::filesystem::path& file) {
    const flightpaths::PathScript script = flightpaths::read_path_script(file);
    const sim::AircraftKind* const kind = sim::find_aircraft_kind(script.aircraft);
    if (kind == nullptr || script.samples > max_steps / 120 * script.rate_hz) { return; }
    const flightpaths::FlownPath flown = flightpaths::fly(script, *kind, true);
    for (const sim::AircraftState& state : flown.trajectory.samples()) {
        for (int part = 0; part < 3; ++part) {
            expect(std::isfinite(state.position_m[part]), "a place");
            expect(std::isfinite(state.velocity_mps[part]), "a velocity");
        }
        expect(std::abs(glm::length(state.body_to_world) - 1.0) < 1e-6, "a unit attitude");
    }
}

constexpr const char* all_kinds = R"(aircraft = "f15"
title = "all kinds of legs"
rate_hz = 20
samples = 600
min_clearance_m = 280
angle_of_attack_deg_per_g = 1.2

[start]
north_m = -1500
east_m = 1500.5
height_m = 300
heading_deg = 0
speed_mps = 235

[[leg]]
fly = "straight"
duration_s = 3

[[leg]]
fly = "turn"
label = "left"
side = "left"
bank_deg = 60
heading_change_deg = 30
acceleration_mps2 = -0.3

[[leg]]
fly = "climb"
climb_deg = 10
to_height_m = 400

[[leg]]
fly = "jink"
duration_s = 4
lateral_g = 1.0
period_s = 2
vertical_g = 0.3
vertical_period_s = 2

[[leg]]
fly = "straight"
duration_s = 30
)";

constexpr const char* helicopter = R"(aircraft = "500md"
title = "helicopter"
rate_hz = 10
samples = 200
min_clearance_m = 20

[start]
north_m = 0
east_m = 0
height_m = 60
heading_deg = 90
speed_mps = 40

[[leg]]
fly = "hold"
duration_s = 25
)";

const Registered target({
    .name = "path_script",
    .file = "input.toml",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{all_kinds, helicopter};
        },
    .words = {"[[leg]]\n", "fly = ", "\"straight\"\n", "\"turn\"\n", "\"jink\"\n", "\"pull\"\n", "\"push\"\n",
        "\"dive\"\n", "\"hold\"\n", "load_factor_g = ", "climb_deg = ", "duration_s = ", "to_speed_mps = ", "[start]\n",
        "inf", "nan", "1979-05-27", "[1]", "true", "'''"},
});

} // namespace path_script

namespace run_file {

/// A run file is read for its report, and for its settings to fly them again.
void use(const std::filesystem::path& file) {
    ui::report::is_run_file(file);
    ui::report::read_run_file(file);
    ui::settings::read_settings(file);
}

std::vector<std::string> seeds() {
    ui::report::RunInfo info;
    info.title = "a flight";
    info.settings_json = ui::settings::settings_json({}).dump();
    info.version = "0.1.0";
    info.commit = "abc1234";
    info.device = "some, renderer";
    info.path_offset_m = {0.0, 0.0, 412.5};
    info.machine.cpu = "cpu, fast";
    info.machine.cores = 2;
    info.machine.memory_kb = 1024;
    info.facts = {{"lowest height", "61 m"}};
    info.notes = {"a note"};
    info.inputs = {{"a.obj", "0123456789abcdef"}};
    ui::report::RunSummary end;
    end.state_hash = 12345;
    end.picture_hash = 6789;
    end.cpu_times = {1000, 500, 10, 100};
    return {ui::report::run_json(info), ui::report::run_json(info, end, {})};
}

const Registered target({
    .name = "run_file",
    .file = "run.json",
    .use = use,
    .seeds = seeds,
    .words = {"\"cores\":", "\"settings\":", "\"machine\":", "\"summary\":", "\"path_offset_m\":", "null", "[]", "{}",
        "true", "1e308", "\"\\u0000\"", "\"\\ud800\"", "\"f15\""},
});

} // namespace run_file

namespace settings {

namespace settings = ui::settings;

/// Settings that were taken are the same when they are written and read again.
void use(const std::filesystem::path& file) {
    const std::string text = settings::settings_json(settings::read_settings(file)).dump();
    const std::filesystem::path written = file.parent_path() / "again.json";
    write_file(written, text);
    expect(settings::settings_json(settings::read_settings(written)).dump() == text, "the same again");
}

const Registered target({
    .name = "settings",
    .file = "settings.json",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{
                "{}", settings::settings_json({}).dump(), settings::settings_json({}).dump(1)};
        },
    .words = {"null", "\"\"", "[]", "{}", "true", "1e308", "-1", "\"f15\"", "\"canyon\"", "\"#ff0000\"", "[0,0,0]",
        "\"\\u0000\""},
});

} // namespace settings

namespace sweep {

/// Every flight has a name of its own that can be a file's.
void use(const std::filesystem::path& file) {
    const ui::sweep::Sweep sweep = ui::sweep::read_sweep(file);
    expect(!sweep.runs.empty() && sweep.runs.size() <= ui::sweep::max_runs, "as many as may be");
    std::set<std::string> names;
    for (const ui::sweep::SweepRun& run : sweep.runs) {
        expect(!run.name.empty() && run.name.front() != '.' && run.name.find('/') == std::string::npos,
            "a name that a file can have");
        expect(names.insert(run.name).second, "a name of its own");
    }
}

constexpr const char* lists = R"(name = "budgets"
repeats = 2
[settings]
size = "64x48"
terrain = "none"
[vary]
path = ["straight", "turn"]
aircraft = ["f15", ["f15", "500md"]]
triangles = { from = 2000, to = 6000, step = 2000 }
)";

constexpr const char* groups = R"([settings]
path = "jinking"
[vary]
fov = { from = 40, to = 60, step = 10 }
[vary.order.paper]
order-method = "paper"
[vary.order.tree]
order-method = "tree"
samples = 4
)";

const Registered target({
    .name = "sweep",
    .file = "input.toml",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{lists, groups};
        },
    .words = {"[settings]\n", "[vary]\n", "[vary.a.b]\n", "repeats = ", "{ from = 1, to = 9, step = 2 }", "step = 0",
        "step = -1", "to = 1e18", "\"../x\"", "\".\"", "[[1]]", "path = [\"turn\"]\n", "nan", "inf", "true", "'''"},
});

} // namespace sweep

namespace track {

/// Asks for states between the samples, and writes and reads the track again to the last bit.
void use(const std::filesystem::path& file) {
    const flightpaths::RecordedTrack track = flightpaths::read_recorded_track(file);
    const sim::Trajectory& flight = track.trajectory;
    for (int step = 0; step <= 20; ++step) {
        const double time_s = flight.start_s() + step / 20.0 * (flight.end_s() - flight.start_s());
        const sim::AircraftState state = flight.state_at(time_s);
        for (int part = 0; part < 3; ++part) {
            expect(std::isfinite(state.position_m[part]), "a place");
            expect(std::isfinite(state.velocity_mps[part]), "a velocity");
        }
        expect(std::abs(glm::length(state.body_to_world) - 1.0) < 1e-5, "a unit attitude");
    }
    const std::string text = flightpaths::exact_track_csv(flight);
    const std::filesystem::path written = file.parent_path() / "again.csv";
    write_file(written, text);
    const flightpaths::RecordedTrack again = flightpaths::read_recorded_track(written);
    expect(flightpaths::exact_track_csv(again.trajectory) == text, "the same track again");
}

std::vector<std::string> seeds() {
    return {"t_s,north_m,east_m,alt_m\n0,0,0,300\n0.5,60,0,300\n1,120,2,301\n2,240,9,300\n",
        "t_s,north_m,east_m,alt_m,roll_deg,pitch_deg,yaw_deg,v_north_mps,v_east_mps,v_up_mps,n_g\n"
        "0,0,0,300,0,1,2,100,0,0,1\n0.05,5,0,300,3,1,2,100,0,0,1.1\n0.1,10,0,300,6,1,2,100,0,0,1."
        "2\n",
        "t_s,north_m,east_m,alt_m,v_north_mps,v_east_mps,v_up_mps,n_g,q_w,q_x,q_y,q_z\n"
        "0,0,0,300,100,0,0,1,1,0,0,0\n0.1,10,0,300,100,0,0,1,0.6,0.8,0,0\n",
        "Timestamp,UTC,Callsign,Position,Altitude\n1704180175,2024-01-02T07:22:55Z,A1,\"47.0,8.0\","
        "1000\n1704180177,2024-01-02T07:22:57Z,A1,\"47.001,8.0\",1000\n",
        "#airframe_info\n#yyy-mm-dd, hh:mm:ss, degrees, degrees, ft msl, deg, deg\n  Lcl Date, Lcl "
        "Time, "
        "Latitude, Longitude, AltMSL, Pitch, Roll\n2021-06-13, 23:59:59, 47.0, 8.0, 1000, 4, -20\n"
        "2021-06-14, 00:00:00, 47.001, 8.0, 1000, 4, -20\n",
        "time,lat,lon,hMSL,velN,velE,velD\n,(deg),(deg),(m),(m/s),(m/s),(m/s)\n"
        "2018-08-12T14:25:43.07Z,47.1,15.4,3474.0,24.1,-45.3,-0.8\n"
        "2018-08-12T14:25:43.27Z,47.10001,15.4,3474.0,24.1,-45.3,-0.8\n",
        "AXCS123\r\nHFDTE160701\r\nB2359584700000N00800000EA0048000500120\r\n"
        "B2359594700060N00800000EV0048000500120\r\nB0000004700120N00800000EA-048000500120\r\n",
        "<?xml version=\"1.0\"?>\n<gpx><!-- a --><trk><trkseg><trkpt lat=\"47\" "
        "lon=\"8\"><ele>500</ele>"
        "<time>2024-01-02T23:59:58Z</time></trkpt>\n<trkpt lon='8.0' lat='47.001'><time>2024-01-02T"
        "23:59:59Z</time><ele>500.0</ele></trkpt></trkseg></trk></gpx>\n",
        "Time\tLatitude Geodetic (deg)\tLongitude (deg)\tAltitude ASL (ft)\tPhi (deg)\tTheta "
        "(deg)\t"
        "Psi (deg)\tV_{North} (ft/s)\tV_{East} (ft/s)\tV_{Down} (ft/s)\n"
        "0\t49.3\t-123.1\t1000\t0\t0\t90\t0\t200\t0\n1\t49.3\t-123."
        "0992\t1000\t0\t0\t90\t0\t200\t0\n"};
}

const Registered target({
    .name = "track",
    .file = "input.csv",
    .use = use,
    .seeds = seeds,
    .words = {"t_s,", "q_w,", "n_g,", "<trkpt", "</trkpt>", "<!--", "Time\t", "Longitude (deg)\t", "Latitude (deg)\t",
        ",,", "\r\n", "1e7", "90", "180", "-180"},
});

} // namespace track

namespace window_keys {

/// Wrong lines are told and left out; what was taken is the same when it is written and read again.
void use(const std::filesystem::path& file) {
    const ui::window::KeyMapFile read = ui::window::read_key_map(file);
    for (const std::string& fault : read.errors) {
        expect(fault.starts_with(file.string()), "a fault that names the file, got " + fault);
        expect(fault.find('\n') == fault.npos, "a fault of one line, got " + fault);
    }
    const std::filesystem::path written = file.parent_path() / "again";
    const std::string text = ui::window::text_of_key_map(read.keys);
    write_file(written, text);
    const ui::window::KeyMapFile again = ui::window::read_key_map(written);
    expect(ui::window::text_of_key_map(again.keys) == text, "the same keys again");
}

const Registered target({
    .name = "window_keys",
    .file = "keys",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{ui::window::text_of_key_map({}), "# c\n\n"};
        },
    .words = {" = ", "none", "Space", "F1", "axis ", "reversed", "left", "#", "-1", "99", "\r\n"},
});

} // namespace window_keys

namespace window_layout {

/// Takes anything; what it kept is the same when it is written and read again.
void use(const std::filesystem::path& file) {
    namespace window = ui::window;
    const std::string kept = window::text_of_layout(window::layout_from(read_file(file)));
    expect(window::text_of_layout(window::layout_from(kept)) == kept, "the same layout again");
}

std::vector<std::string> seeds() {
    const std::string panels = ui::window::text_of_layout({{"Scene", {}}, {"First steps", {}}, {"Terrain", {}}});
    return {panels, "[Table][0x00000001,999999999]\n" + panels, ""};
}

const Registered target({
    .name = "window_layout",
    .file = "layout.ini",
    .use = use,
    .seeds = seeds,
    .words = {"[Window]", "Pos=", "Size=", "[Table][0x1,9]", "nan", "inf", "\n", ","},
});

} // namespace window_layout

} // namespace

} // namespace octant::tests::formats
