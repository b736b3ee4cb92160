#include "sim/base/output_file.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/flight_accumulator.h"
#include "ui/report/html_report.h"
#include "ui/report/html_text.h"
#include "ui/report/recording_writer.h"
#include "ui/report/slow_pictures.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

using namespace octant;
using namespace octant::ui::report;
using Catch::Contains;

namespace {

LoadedRecording made_up_recording(const std::filesystem::path& folder, const std::string& title, double draw_ms) {
    RunInfo info;
    info.title = title;
    info.settings_json = R"({"note":"<script>&","rate":60})";
    info.machine.cores = 2;
    std::vector<FrameRecord> frames = made_up_frames(30, draw_ms);
    frames[20] = made_up_frame(20, 30.0);
    record_frames(folder, frames, {0xaaa, 0xbbb, {}}, info);
    for (int frame = 0; frame < 14; ++frame) {
        write_png(folder / fmt::format("picture-{:05}.png", frame), made_up_picture(8, 4, 3).view());
    }
    return load_recording(folder);
}

std::size_t count_of(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) { ++count; }
    return count;
}

FlightAccumulator digest_of(const std::vector<FrameRecord>& records) {
    FlightAccumulator digest;
    for (const FrameRecord& record : records) { digest.add(record); }
    return digest;
}

} // namespace

TEST_CASE("text is escaped for elements and attributes, and broken UTF-8 mended") {
    CHECK(escaped("<a href=\"x\">'&'</a>") == "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
    CHECK(escaped("\xC3\xA9\n\x01\x7F.") == "\xC3\xA9\n.");
    CHECK(escaped("\xC3") == "\xEF\xBF\xBD");
    CHECK(escaped("\xC0\xAF") == "\xEF\xBF\xBD\xEF\xBF\xBD");
    CHECK(escaped("\xED\xA0\x80x") == "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBDx");
}

TEST_CASE("a table sets numbers right and escapes the rest") {
    ResultTable table{.title = "T<", .note = "n>"};
    table.add({{"a", "x&y"}, {"b", 1.5}});
    table.add({{"a", "z"}, {"b", ""}});
    CHECK(html_of(table) == "<h3>T&lt;</h3>\n<div class=\"scroll\"><table>\n<thead><tr><th>a</th>"
                            "<th class=\"number\">b</th></tr></thead>\n<tbody>\n"
                            "<tr><td>x&amp;y</td><td class=\"number\">1.5</td></tr>\n"
                            "<tr><td>z</td><td></td></tr>\n</tbody></table></div>\n<p class=\"note\">n&gt;</p>\n");
}

TEST_CASE("a page shows a flight whole, fetches nothing and lets no text through as markup") {
    const ScratchFolder scratch;
    const std::vector recordings{made_up_recording(scratch / "one", "<b>flight</b>", 5.0)};
    std::vector<ResultTable> first_tables(1);
    first_tables[0].add({{"x", "<i>"}});
    const std::string page = html_report(recordings, first_tables);
    CHECK_THAT(page, Catch::StartsWith("<!DOCTYPE html>"));
    CHECK_THAT(page, Contains("<h1>&lt;b&gt;flight&lt;/b&gt;</h1>"));
    CHECK_THAT(page, Contains("&lt;script&gt;&amp;"));
    CHECK_THAT(page, Contains("&lt;i&gt;"));
    for (const char* unwanted : {"<script>&", "<b>", "<i>", "<link", "src=\"http", "@import", "src=\"//"}) {
        CHECK_THAT(page, !Contains(unwanted));
    }
    CHECK(count_of(page, "data:image/png;base64,") == 12 + 4); // and of the slowest frames
    CHECK(count_of(page, "<script") == 1 + 5);                 // and the numbers of each plot
    CHECK_THAT(page, Contains("12 of 14 pictures"));
    for (const Statistic& statistic : all_statistics()) { CHECK_THAT(page, Contains(escaped(statistic.definition))); }
    CHECK_THAT(page, Contains("1 of 28 frames took longer than 16.67 ms. In 1 of them draw took"));
    CHECK_THAT(page, Contains("draw by 25.00 ms"));
    CHECK_THAT(page, Contains("0000000000000aaa"));
    CHECK_THAT(page, Contains("<td>rate</td><td class=\"code\">60</td>")); // left, as all values
    CHECK(html_report(recordings, first_tables) == page);
}

TEST_CASE("the slowest frames of a flight are shown by their own pictures") {
    const ScratchFolder scratch;
    LoadedRecording recording = made_up_recording(scratch / "one", "flight", 5.0);
    CHECK_THAT(html_report(std::span(&recording, 1)), Contains(" ms: nearest picture, "));
    SlowPictures pictures;
    for (const int frame : {1, 17, 20, 16, 18, 19}) { // 1 is of the warm-up
        FrameRecord record = made_up_frame(frame, 5.0);
        record.frame_ms = frame == 1 ? 99.0 : frame;
        pictures.add(record, made_up_picture(8, 4, 4).view());
    }
    pictures.add(made_up_frame(21, 1.0), made_up_picture(8, 4, 4).view());
    pictures.write(scratch / "one");
    for (int frame = 0; frame < 30; ++frame) {
        const bool is_kept = frame >= 16 && frame <= 20;
        CHECK(std::filesystem::exists((scratch / "one") / slow_picture_name(frame)) == is_kept);
    }
    recording.slowest.resize(1);
    REQUIRE(recording.slowest.front().record.frame == 20);
    CHECK_THAT(html_report(std::span(&recording, 1)), Contains(" ms</figcaption>") && !Contains(": nearest picture"));
}

TEST_CASE("several flights stand in a table, and those of the same flight are compared") {
    const ScratchFolder scratch;
    std::vector recordings{
        made_up_recording(scratch / "one", "first", 5.0), made_up_recording(scratch / "two", "second", 7.0)};
    recordings[1].run.settings[0].second = "other";
    std::string page = html_report(recordings);
    CHECK_THAT(page, Contains("2 flights compared"));
    CHECK_THAT(page, Contains("<th>note</th>"));
    CHECK_THAT(page, !Contains("rate</th>"));
    CHECK_THAT(page, Contains("<td>+23.5 %</td>")); // 8.5 to 10.5; too few runs to judge
    CHECK(count_of(page, "data:image/png;base64,") == 2);
    CHECK(count_of(page, "class=\"plot small\"") == 2);
    recordings[1].run.settings[1].second = "20";
    page = html_report(recordings);
    CHECK_THAT(page, Contains("rate</th>"));
    CHECK_THAT(page, Contains("No two of these recordings are of the same flight"));
    CHECK_THAT(page, !Contains("%</td>"));
    recordings[1].name = "one";
    CHECK_THAT(html_report(recordings), Contains((scratch / "two").string()));
    write_file(scratch / "two/report.html", "its own");
    CHECK_THAT(html_report(recordings, {}, scratch.path()), Contains("<a href=\"two/report.html\">"));
}

TEST_CASE("a change that repeats bear out is marked, and a long study stays small") {
    const ScratchFolder scratch;
    const LoadedRecording base = made_up_recording(scratch / "one", "first", 5.0);
    std::vector<LoadedRecording> recordings;
    for (int i = 0; i < 200; ++i) {
        recordings.push_back(base);
        recordings.back().name = "run-" + std::to_string(i);
        const double more = (i % 2 == 0 ? 0.0 : 1.0) + 0.01 * (i % 7);
        recordings.back().run.settings[0].second = i % 2 == 0 ? "old" : "new";
        recordings.back().statistics.p50_ms += more;
    }
    const std::string page = html_report(recordings);
    CHECK_THAT(page, Contains("<td class=\"worse\">+11.7 % ("));
    CHECK_THAT(page, Contains("12 of 200 runs"));
    const std::size_t overlaid = page.find("Frame time of each run");
    REQUIRE(overlaid != std::string::npos);
    const std::string curves = page.substr(overlaid, page.find("</script>", overlaid) - overlaid);
    CHECK_THAT(curves, Contains("run-10\"") && Contains("run-11\"") && !Contains("run-12\""));
    CHECK(count_of(page, "class=\"plot small\"") == 200);
    CHECK(count_of(page, "data:image/png;base64,") == 24);
    recordings[1].run.noise = {"Other programs used 50 % of the processor time."};
    const std::string noisy = html_report(recordings);
    CHECK_THAT(noisy, Contains("<td>+11.7 % (") && Contains("noisy runs is called"));
    CHECK(page.size() < 3'000'000);
}

TEST_CASE("a killed and noisy flight, a flight without frames and a bad picture are said") {
    const ScratchFolder scratch;
    LoadedRecording recording = made_up_recording(scratch / "one", "t", 5.0);
    recording.ended_early = true;
    recording.run.noise = {"Other programs used 50.0 % of the processor time."};
    write_file(recording.pictures[0], "broken");
    std::string page = html_report(std::vector{recording});
    CHECK_THAT(page, Contains("<span class=\"badge bad\">ended early</span>"));
    CHECK_THAT(page, Contains("<span class=\"badge bad\">noisy</span>"));
    CHECK_THAT(page, Contains("Other programs used 50.0 %"));
    CHECK_THAT(page, Contains("picture-00000.png: expected a PNG picture"));
    recording.flight = {};
    recording.slowest.clear();
    recording.statistics = {};
    page = html_report(std::vector{recording});
    CHECK_THAT(page, Contains("no frames"));
    CHECK_THAT(page, !Contains("nan"));
    CHECK_THAT(html_report({}), Contains("</html>"));
}

TEST_CASE("a flight whose triangle target moved shows its course and its stress") {
    const ScratchFolder scratch;
    std::vector<FrameRecord> records;
    for (int frame = 0; frame < 6; ++frame) {
        records.push_back(made_up_frame(frame, 5.0));
        records.back().triangle_target = frame < 2 ? 90 : 100 + 10 * frame; // the first two warm up
        records.back().stress = frame < 2 ? std::nan("") : 0.8;
    }
    const FlightAccumulator flight = digest_of(records);
    CHECK(flight.triangle_targets().min_triangles == 120);
    CHECK(flight.triangle_targets().max_triangles == 150);
    CHECK(flight.triangle_targets().mean == 135.0);
    const auto plots = flight_plots(flight, 20.0);
    REQUIRE(plots.size() == 7);
    CHECK(plots[5].title == "Triangle target");
    CHECK(plots[5].series[0].y == std::vector<double>{120.0, 130.0, 140.0, 150.0});
    CHECK(plots[6].title == "Stress");
    LoadedRecording recording = made_up_recording(scratch / "one", "t", 5.0);
    CHECK_THAT(html_report(std::vector{recording}), !Contains("<dt>Triangle target</dt>"));
    recording.flight = flight;
    CHECK_THAT(html_report(std::vector{recording}),
        Contains("<dt>Triangle target</dt><dd>135 <small>mean of 120 to 150</small>"));
}

TEST_CASE("a long flight is thinned without losing its peak") {
    std::vector<FrameRecord> records;
    for (int frame = 0; frame < 50'000; ++frame) {
        records.push_back(made_up_frame(frame, frame == 33'333 ? 20.0 : 5.0));
    }
    const auto plots = flight_plots(digest_of(records), 30.0);
    REQUIRE(plots.size() == 5);
    const PlotSeries& times = plots[0].series[1];
    CHECK(times.x.size() < 3000);
    CHECK(*std::max_element(times.y.begin(), times.y.end()) == 23.5);
    const PlotSeries& top_stage = plots[2].series[3];
    CHECK(top_stage.x.size() < 3000);
    CHECK(*std::max_element(top_stage.y.begin(), top_stage.y.end()) == 23.5);
    double counted = 0.0;
    for (const double count : plots[1].series[0].y) { counted += count; }
    CHECK(counted == 49'998.0);
}

TEST_CASE("a plot of frame times ends above nearly all frames and, unless they are far below it, above 16.67 ms") {
    std::vector<FrameRecord> records;
    for (int frame = 0; frame < 1000; ++frame) { records.push_back(made_up_frame(frame, frame == 500 ? 996.5 : 16.5)); }
    CHECK(plot_ceiling_ms(statistics_of(records)) == Approx(1.05 * 2.5 * 20.0));
    CHECK(plot_ceiling_ms({}) == Approx(1.05 * 18.0));
    const auto ceiling_ms = [](double p99_ms, double max_ms) {
        Statistics statistics;
        statistics.p99_ms = p99_ms;
        statistics.max_ms = max_ms;
        return plot_ceiling_ms(statistics);
    };
    CHECK(ceiling_ms(0.4, 0.5) == Approx(1.05 * 0.5));
    CHECK(ceiling_ms(0.4, 30.0) == Approx(1.05 * 1.0));
    CHECK(ceiling_ms(2.0, 30.0) == Approx(1.05 * 18.0));
}

TEST_CASE("a curve keeps every peak in the memory of a plot") {
    Curve curve;
    for (int i = 0; i < 1'000'000; ++i) { curve.add(i, i == 777'777 ? 9.0 : i == 3 ? -9.0 : i % 2); }
    const PlotSeries whole = curve.series();
    CHECK(whole.x.size() <= 2 * 900);
    CHECK(std::ranges::is_sorted(whole.x));
    CHECK(*std::ranges::max_element(whole.y) == 9.0);
    CHECK(*std::ranges::min_element(whole.y) == -9.0);
    const PlotSeries few = curve.series(10);
    CHECK(few.x.size() <= 20);
    CHECK(*std::ranges::max_element(few.y) == 9.0);
    Curve gaps;
    gaps.add(0.0, std::nan(""));
    gaps.add(1.0, 2.0);
    CHECK(gaps.series(1).y == std::vector<double>{2.0});
    CHECK(std::isnan(gaps.series().y.front()));
}

TEST_CASE("settings that are not set are not shown, and counters are where there are some") {
    const ScratchFolder scratch;
    LoadedRecording recording = made_up_recording(scratch / "one", "t", 5.0);
    CHECK(recording.has_counters);
    recording.run.settings.emplace_back("frames", unset_value);
    CHECK_THAT(html_report(std::vector{recording}), !Contains("null</td>"));
    CHECK_THAT(html_report(std::vector{recording, recording}), !Contains("null</td>"));
    std::filesystem::remove(scratch / "one/counters.csv");
    const LoadedRecording older = load_recording(scratch / "one");
    CHECK_FALSE(older.has_counters);
    CHECK_THAT(html_report(std::vector{older}), !Contains("page faults"));
    CHECK_THAT(html_report(std::vector{recording}), Contains("page faults"));
}
