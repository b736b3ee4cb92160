#include "sim/base/output_file.h"
#include "sim/base/random_generator.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/comparison.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>

using namespace octant;
using namespace octant::ui::report;

namespace {

SettingRole role_of_setting(std::string_view name) {
    if (name == "pictures") { return SettingRole::Ignored; }
    return name == "path" || name == "zoom" ? SettingRole::Scene : SettingRole::Drawing;
}

LoadedRecording run_of(
    const std::string& path, const std::string& method, double p50_ms, const std::string& start = "") {
    LoadedRecording recording;
    recording.name = path + "-" + method;
    recording.folder.path = recording.display_name = recording.name;
    recording.run.settings = {{"path", path}, {"zoom", "1"}, {"order-method", method}};
    recording.run.machine_info.start_time_utc = start;
    recording.statistics.frames = 10;
    recording.statistics.p50_ms = p50_ms;
    recording.statistics.p99_ms = 2.0 * p50_ms;
    return recording;
}

std::string utc_second(int n) { return fmt::format("2026-01-01T00:00:{:02}Z", n); }

/// Recordings of one flight: `before` and `after` are the P50 of the runs of two variants, flown one after the other.
std::vector<LoadedRecording> two_variants(const std::vector<double>& before, const std::vector<double>& after) {
    std::vector<LoadedRecording> runs;
    for (const double ms : before) {
        runs.push_back(run_of("turn", "paper", ms, utc_second(static_cast<int>(runs.size()))));
    }
    for (const double ms : after) {
        runs.push_back(run_of("turn", "exact", ms, utc_second(static_cast<int>(runs.size()))));
    }
    return runs;
}

/// A recording with frames.csv of 120 frames of about that time, in a folder of its own.
LoadedRecording recorded(const ScratchFolder& scratch, const std::string& method, double frame_ms, int number) {
    LoadedRecording recording = run_of("turn", method, frame_ms, utc_second(number));
    recording.run.state_hash = "0123456789abcdef";
    recording.run.picture_hash = method == "paper" ? "1111111111111111" : "2222222222222222";
    recording.folder.path = scratch / fmt::format("{}-{}", method, number);
    std::filesystem::create_directories(recording.folder.path);
    std::string rows = frame_csv_header();
    RandomGenerator dice(static_cast<unsigned>(number));
    for (int k = 0; k < 120; ++k) {
        FrameRecord row;
        row.frame = k;
        row.warm_up = k < 10;
        row.draw_ms = frame_ms * std::exp(0.01 * dice.normal_deviate()) - 1.0;
        row.plan_ms = 1.0;
        row.frame_ms = row.plan_ms + row.draw_ms;
        rows += frame_csv_line(row);
    }
    write_file(recording.folder.path / "frames.csv", rows);
    return recording;
}

} // namespace

TEST_CASE("recordings are one flight where nothing of the scene differs, and variants by drawing and program") {
    std::vector runs{run_of("turn", "exact", 1.0), run_of("straight", "exact", 1.0), run_of("turn", "paper", 1.0),
        run_of("turn", "exact", 1.0), run_of("turn", "exact", 1.0), run_of("turn", "exact", 1.0)};
    runs[3].run.settings.emplace_back("pictures", "5");
    runs[4].run.settings[1].second = "2";
    runs[5].run.machine = {{"program.version", "1.1"}, {"program.commit", "abc"}, {"program.hash", "f00"}};
    const auto flights = compared_flights(runs, role_of_setting);
    REQUIRE(flights.size() == 3);
    REQUIRE(flights[0].variants.size() == 3);
    CHECK(flights[0].variants[0].runs == std::vector<std::size_t>{0, 3});
    CHECK(flights[0].variants[1].runs == std::vector<std::size_t>{2});
    CHECK(flights[0].variants[1].name == "order-method paper");
    CHECK(flights[0].variants[2].name == "order-method exact, 1.1 (abc)");
    CHECK(flights[1].variants[0].runs == std::vector<std::size_t>{1});
    CHECK(flights[2].variants[0].runs == std::vector<std::size_t>{4});
    CHECK(flight_differences(runs[0], runs[1], role_of_setting) == std::vector<std::string>{"path"});
    CHECK(flight_differences(runs[0], runs[4], role_of_setting) == std::vector<std::string>{"zoom"});
    CHECK(flight_differences(runs[0], runs[2], role_of_setting).empty());
}

TEST_CASE("files of one name are one flight only with the same contents; their folders do not matter") {
    std::vector runs{
        run_of("/a/x.toml", "exact", 1.0), run_of("/b/x.toml", "exact", 1.0), run_of("/b/x.toml", "exact", 1.0)};
    runs[0].run.inputs = {{"/a/x.toml", "11"}};
    runs[1].run.inputs = {{"/b/x.toml", "11"}};
    runs[2].run.inputs = {{"/b/x.toml", "22"}};
    CHECK(flight_differences(runs[0], runs[1], role_of_setting).empty());
    CHECK(flight_differences(runs[0], runs[2], role_of_setting) == std::vector<std::string>{"x.toml"});
    for (LoadedRecording& run : runs) { run.run.title = "x"; }
    const auto flights = compared_flights(runs, role_of_setting);
    REQUIRE(flights.size() == 2);
    CHECK(flights[0].name == "x, x.toml 11");
    CHECK(flights[1].name == "x, x.toml 22");
    runs[1].run.machine_info.cores = 8;
    CHECK(flight_differences(runs[0], runs[1], role_of_setting) == std::vector<std::string>{"processor"});
}

TEST_CASE("flights with one title are told apart by what differs, by hashes in eight digits, and by a number at last") {
    std::vector runs{run_of("turn", "exact", 1.0), run_of("turn", "exact", 1.0), run_of("turn", "exact", 1.0),
        run_of("pop-up", "exact", 1.0)};
    for (LoadedRecording& run : runs) { run.run.title = "f15"; }
    runs[3].run.title = "other";
    runs[0].run.inputs = {{"a/x.obj", "0123456789abcdef"}, {"b/x.obj", "1111111111111111"}};
    runs[1].run.inputs = {{"a/x.obj", "0123456789abcdef"}, {"b/x.obj", "2222222222222222"}};
    runs[2].run.settings[1].second = "2";
    const auto flights = compared_flights(runs, role_of_setting);
    REQUIRE(flights.size() == 4);
    CHECK(flights[0].name == "f15, x.obj 01234567, zoom 1");
    CHECK(flights[1].name == "f15, x.obj 01234567, zoom 1 (2)");
    CHECK(flights[2].name == "f15, x.obj not set, zoom 2");
    CHECK(flights[3].name == "other");
}

TEST_CASE("eight rounds of many flights show a change, which ranks alone could not") {
    std::vector<FlightChange> changes(24);
    for (FlightChange& change : changes) { change.frames.change = centre_of(std::vector(8, 0.0)); }
    changes[7].frames.change = centre_of(std::vector{0.10, 0.11, 0.09, 0.10, 0.12, 0.08, 0.10, 0.11});
    adjust_for_number(changes);
    CHECK(changes[7].is_changed());
    CHECK(std::ranges::count_if(changes, &FlightChange::is_changed) == 1);
}

TEST_CASE("the baseline is the first variant given, or the one that is asked for") {
    const std::vector runs{run_of("turn", "paper", 1.0), run_of("turn", "exact", 1.0)};
    CHECK(compared_flights(runs, role_of_setting)[0].variants[0].runs == std::vector<std::size_t>{0});
    for (const char* const name : {"order-method exact", "turn-exact"}) {
        const auto variants = compared_flights(runs, role_of_setting, name)[0].variants;
        CHECK(variants[0].runs == std::vector<std::size_t>{1});
        CHECK(variants[1].runs == std::vector<std::size_t>{0});
    }
    const std::vector two{run_of("turn", "paper", 1.0), run_of("turn", "exact", 1.0), run_of("pop-up", "paper", 1.0),
        run_of("pop-up", "exact", 1.0)};
    CHECK(compared_flights(two, role_of_setting, "turn-exact")[1].variants[0].runs == std::vector<std::size_t>{3});
    CHECK_THROWS_WITH(compared_flights(runs, role_of_setting, "fast"),
        "--baseline: expected one of the recordings or the name of a variant such as 'order-method paper', got 'fast'");
}

TEST_CASE("a gate fails where the whole interval is above what it allows") {
    const Gate gate = read_gate("p50=5%,p99=10%");
    CHECK(gate == Gate{{"p50_ms", 0.05}, {"p99_ms", 0.10}});
    const auto result = [&](const std::vector<LoadedRecording>& runs) {
        return gate_result(runs, compared_flights(runs, role_of_setting), gate);
    };
    CHECK(result(two_variants({10.0, 10.01, 9.99}, {10.3, 10.31, 10.29})).failures.empty());
    CHECK(result(two_variants({10.0, 12.0, 9.0}, {11.0, 13.0, 10.0})).failures.empty());
    const GateResult slower = result(two_variants({10.0, 10.01, 9.99}, {13.0, 13.01, 12.99}));
    REQUIRE(slower.failures.size() == 2);
    CHECK(slower.failures[0] == "turn-paper, order-method exact: p50_ms +30.0 % (+29.2 to +30.8 %), above +5.0 %");
    const GateResult few = result(two_variants({10.0, 10.0}, {13.0, 13.0}));
    CHECK(few.failures.empty());
    CHECK(few.undecided.size() == 2);
    CHECK(result({run_of("turn", "paper", 1.0), run_of("turn", "paper", 9.0)}).undecided ==
          std::vector<std::string>{"all recordings are repeats of one variant of one flight by the same program"});
    CHECK(result({run_of("turn", "paper", 1.0), run_of("pop-up", "paper", 9.0)}).undecided ==
          std::vector<std::string>{"no two recordings are variants of one flight"});
    for (const char* wrong : {"", "p50", "p50=5", "p51=5%", "frames=5%", "p50=-5%", "p50=x%"}) {
        CHECK_THROWS_WITH(read_gate(wrong), Catch::StartsWith("--gate: expected figures"));
    }
}

TEST_CASE("a slower stage of recordings is told in one line, in a verdict and in all columns") {
    const ScratchFolder scratch;
    std::vector<LoadedRecording> runs;
    for (int r = 0; r < 12; ++r) { // in rounds, in changing order
        const bool is_old = (r % 2 == 0) != (r % 4 > 1);
        runs.push_back(recorded(scratch, is_old ? "paper" : "exact", is_old ? 5.0 : 5.5, r));
    }
    const auto flights = compared_flights(runs, role_of_setting);
    const std::vector<FlightChange> changes = flight_changes(runs, flights, role_of_setting);
    REQUIRE(changes.size() == 1);
    const FlightChange& change = changes.front();
    CHECK(change.frames.pairing == Pairing::Rounds);
    CHECK(change.frames.frames == 110);
    CHECK(change.frames.share() == Approx(0.1).margin(0.003));
    CHECK(change.same_states);
    CHECK_FALSE(change.same_pictures);
    CHECK(change.is_changed());
    CHECK(answer_text(changes, 0.0, 0.02) == fmt::format("{:.1f} % slower ({:.1f} to {:.1f} %); draw stage +0.5 ms",
                                                 100.0 * change.frames.share(), 100.0 * change.frames.low_share(),
                                                 100.0 * change.frames.high_share()));
    CHECK(verdict_of(changes, 0.0, 0.02) == Verdict::Slower);
    CHECK(verdict_of(changes, 0.2, 0.02) == Verdict::NotSlower);
    CHECK(verdict_of(changes, change.frames.share(), 1e-5) == Verdict::CannotTell);
    CHECK_THAT(answer_text(changes, change.frames.share(), 1e-5),
        Catch::Contains("draw stage +0.5 ms; cannot tell whether more than 10 % slower"));
    const std::string line = csv_line(change_columns(), change);
    CHECK_THAT(line, Catch::Contains(",rounds,6,6,110,") && Catch::Contains(",1,draw,0.50"));
}

TEST_CASE("of a change that may go either way only the interval is told") {
    const ScratchFolder scratch;
    std::vector<LoadedRecording> runs;
    constexpr std::array<double, 8> ms{5.0, 4.0, 5.2, 9.0, 8.0, 5.0, 5.1, 6.0};
    for (std::size_t r = 0; r < ms.size(); ++r) {
        runs.push_back(recorded(scratch, r % 2 == 0 ? "paper" : "exact", ms[r], static_cast<int>(r)));
    }
    const auto changes = flight_changes(runs, compared_flights(runs, role_of_setting), role_of_setting);
    REQUIRE(changes.size() == 1);
    REQUIRE_FALSE(changes.front().is_changed());
    CHECK(verdict_of(changes, 0.0, 0.02) == Verdict::CannotTell);
    CHECK(answer_text(changes, 0.0, 0.02) == fmt::format("cannot tell: between {:.1f} % faster and {:.1f} % slower",
                                                 -100.0 * changes.front().frames.low_share(),
                                                 100.0 * changes.front().frames.high_share()));
}

TEST_CASE("flights of two recordings of each side have no interval, and that is said") {
    const ScratchFolder scratch;
    const std::vector runs{recorded(scratch, "paper", 5.0, 1), recorded(scratch, "exact", 6.0, 2)};
    const auto changes = flight_changes(runs, compared_flights(runs, role_of_setting), role_of_setting);
    CHECK(verdict_of(changes, 0.0, 0.02) == Verdict::CannotTell);
    CHECK_THAT(
        answer_text(changes, 0.0, 0.02), Catch::StartsWith("cannot tell (+19.9 % by the medians)") &&
                                             Catch::EndsWith(": expected three flights or more of each, got 1 and 1"));
    std::vector empty = runs;
    empty[1].statistics.frames = 0;
    const auto none = flight_changes(empty, compared_flights(empty, role_of_setting), role_of_setting);
    CHECK_FALSE(std::isfinite(none[0].frames.share()));
    CHECK_THAT(csv_line(change_columns(), none[0]), Catch::Contains(",rounds,1,0,0,0.000,0.000,,,"));
    CHECK(answer_text({}, 0.0, 0.02) == "nothing is compared: no flight has two variants");
}
