#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>

#include <array>
#include <clocale>
#include <cmath>
#include <limits>

using namespace octant;
using namespace octant::ui::report;

namespace {

constexpr const char* promised_columns =
    "frame,sim_time_s,wall_s,frame_ms,sim_ms,plan_ms,draw_ms,read_ms,terrain_triangles,"
    "terrain_fans,aircraft_polygons,draw_cell,resolution_c,triangle_change,stress,overrun";

FrameRecord full_record() {
    FrameRecord record = made_up_frame(7, 12.34567);
    record.warm_up = true;
    record.record_ms = 3.25;
    record.terrain_fans = 12;
    record.aircraft_polygons = 43;
    record.draw_cell = 26;
    record.resolution_c = 0.125;
    record.triangle_change = -5;
    record.stress = 0.3169;
    record.draw_calls = 3;
    record.shadow_triangles = 24;
    record.transparent_triangles = 17;
    record.cuts = 5;
    record.unordered = 1;
    record.eye_m = {1.5, -2.25, 3e6};
    record.aircraft_m = {4.0, 5.0, 6.0};
    record.aircraft_agl_m = 61.25;
    record.triangle_target = 1200;
    record.detail_triangles = 1900;
    record.scenery_triangles = 800;
    record.error_px = 0.75;
    record.latency_ms = 21.5;
    record.missed = 1;
    record.smooth_polygons = 30;
    record.smooth_target = 31;
    record.aircraft_level = 2;
    record.refine_splits = 17;
    record.refine_collapses = 9;
    record.refine_ms = 0.4375;
    record.mesh_wait_ms = 0.25;
    record.draw_wait_ms = 1.5;
    record.state_hash = 0xab;
    return record;
}

} // namespace

TEST_CASE("frames.csv begins with the columns that others rely on") {
    const std::string header = frame_csv_header();
    CHECK(header.substr(0, std::string(promised_columns).size()) == promised_columns);
    CHECK(header.substr(std::string(promised_columns).size()) ==
          ",warm_up,paused,record_ms,draw_calls,shadow_triangles,veil_triangles,cuts,unordered,eye_x_m,eye_"
          "y_m,eye_z_m,"
          "aircraft_x_m,aircraft_y_m,aircraft_z_m,aircraft_agl_m,triangle_target,fine_triangles,"
          "scenery_triangles,error_px,latency_ms,missed,smooth_polygons,smooth_target,aircraft_level,"
          "refine_splits,refine_collapses,refine_ms,mesh_wait_ms,draw_wait_ms,packets,packets_lost,"
          "packets_late,packets_wrong,stale,jitter_"
          "ms,host_frame,skew_frames,state_hash,picture_hash\n");
}

TEST_CASE("a line has fixed decimals whatever the locale") {
    std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
    CHECK(frame_csv_line(full_record()) ==
          "7,0.350000,0.140000,15.8457,1.0000,2.0000,12.3457,0.5000,1007,12,43,26,0.125000,-5,0.3169,"
          "0,1,0,3.2500,3,24,17,5,1,1.500,-2.250,3000000.000,4.000,5.000,6.000,61.250,1200,1900,800,"
          "0.7500,21.5000,1,30,31,2,17,9,0.4375,0.2500,1.5000,0,,0,0,0,0.0000,-1,-1,"
          "00000000000000ab,\n");
    std::setlocale(LC_NUMERIC, "C");
}

TEST_CASE("what is written is read back as it was written") {
    const ScratchFolder scratch;
    const FrameRecord record = full_record();
    write_file(scratch / "frames.csv", frame_csv_header() + frame_csv_line(record));
    const FrameFile file = read_frame_csv(scratch / "frames.csv");
    REQUIRE(file.records.size() == 1);
    CHECK_FALSE(file.is_truncated);
    const FrameRecord& got = file.records[0];
    CHECK(frame_csv_line(got) == frame_csv_line(record)); // which the case before compares column by column
    CHECK(got.draw_ms == rounded_as_csv(record).draw_ms);
    CHECK(got.draw_ms == 12.3457);
    CHECK(got.warm_up);
    CHECK(got.triangle_change == -5);
    CHECK(got.eye_m.z == 3e6);
    CHECK(got.state_hash == 0xab);
    CHECK_FALSE(got.picture_hash);
}

TEST_CASE("what has no value is an empty field") {
    const ScratchFolder scratch;
    FrameRecord record = full_record();
    record.aircraft_agl_m = std::numeric_limits<double>::quiet_NaN();
    record.resolution_c = std::numeric_limits<double>::infinity();
    write_file(scratch / "frames.csv", frame_csv_header() + frame_csv_line(record));
    const FrameRecord got = read_frame_csv(scratch / "frames.csv").records.at(0);
    CHECK(std::isnan(got.aircraft_agl_m));
    CHECK(std::isnan(got.resolution_c));
}

TEST_CASE("a torn last line is left out, wherever it is cut") {
    const ScratchFolder scratch;
    const std::string whole =
        frame_csv_header() + frame_csv_line(made_up_frame(0, 1)) + frame_csv_line(made_up_frame(1, 1));
    const std::size_t first_end = whole.find('\n') + 1;
    const std::size_t second_end = whole.find('\n', first_end) + 1;
    for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
        write_file(scratch / "frames.csv", whole.substr(0, cut));
        const FrameFile file = read_frame_csv(scratch / "frames.csv");
        const std::size_t expected = cut == whole.size() ? 2 : (cut >= second_end ? 1 : 0);
        CAPTURE(cut);
        REQUIRE(file.records.size() == expected);
        REQUIRE(file.is_truncated == (cut != 0 && cut != first_end && cut != second_end && cut != whole.size()));
    }
}

TEST_CASE("columns are found by name, in any order and among strange ones") {
    const ScratchFolder scratch;
    write_file(scratch / "frames.csv",
        "mood,overrun,stress,triangle_change,resolution_c,draw_cell,aircraft_polygons,terrain_fans,"
        "terrain_triangles,read_ms,draw_ms,plan_ms,sim_ms,frame_ms,wall_s,sim_time_s,frame\r\n"
        "good,1,,2,3.5,4,5,6,7,8,9,10,11,38,13,14,15\r\n");
    const FrameRecord got = read_frame_csv(scratch / "frames.csv").records.at(0);
    CHECK(got.frame == 15);
    CHECK(got.frame_ms == 38.0);
    CHECK(got.overrun == 1);
    CHECK_FALSE(got.warm_up);
    constexpr std::array<std::string_view, 1> required_columns{"triangle_target"};
    CHECK_THROWS_WITH(read_frame_csv(scratch / "frames.csv", required_columns),
        Catch::Contains(":1: expected a column triangle_target, got 'mood,overrun,"));
}

TEST_CASE("damage is named by file and line") {
    const ScratchFolder scratch;
    const auto path = scratch / "frames.csv";
    const auto line = [](int frame) { return frame_csv_line(made_up_frame(frame, 1.0)); };
    const auto message = [&](const std::string& text) {
        write_file(path, text);
        return path.string() + ":";
    };
    std::string start = message(frame_csv_header() + line(0) + "1,2\n" + line(2));
    CHECK_THROWS_WITH(read_frame_csv(path), start + "3: expected 55 fields, got 2");
    std::string bad = line(1);
    bad.replace(bad.find("4.5000"), 6, "4.5x");
    start = message(frame_csv_header() + line(0) + bad);
    CHECK_THROWS_WITH(read_frame_csv(path), start + "3: expected a number in column frame_ms, got '4.5x'");
    bad = line(1);
    bad.replace(bad.find("1001"), 4, "1e3");
    start = message(frame_csv_header() + bad);
    CHECK_THROWS_WITH(
        read_frame_csv(path), start + "2: expected a whole number in column terrain_triangles, got '1e3'");
    bad = frame_csv_line(made_up_frame(1, 1.0));
    bad.replace(bad.size() - 2, 1, ",abc");
    start = message(frame_csv_header() + bad);
    CHECK_THROWS_WITH(read_frame_csv(path), start + "2: expected a hash in column picture_hash, got 'abc'");
    start = message(frame_csv_header() + line(3) + line(3));
    CHECK_THROWS_WITH(read_frame_csv(path), start + "3: expected a frame after 3, got 3");
    start = message("a,b\n1,2\n");
    CHECK_THROWS_WITH(read_frame_csv(path), start + "1: expected a column frame, got 'a,b'");
    start = message("frame,frame\n");
    CHECK_THROWS_WITH(read_frame_csv(path), start + "1: expected column frame once, got it twice");
}
