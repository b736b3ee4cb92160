#include "sim/base/output_file.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/comparison.h"
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

SettingRole role_on_page(std::string_view name) {
    if (name == "pictures") { return SettingRole::Ignored; }
    return name == "rate" || name == "path" ? SettingRole::Scene : SettingRole::Drawing;
}

/// The page with what frames.csv of the recordings says of their changes.
std::string compared_page(Recordings recordings) {
    const auto flights = compared_flights(recordings, &role_on_page);
    const auto changes = flight_changes(recordings, flights, &role_on_page);
    return html_report(recordings, {.flights = flights, .changes = changes, .roles = &role_on_page});
}

/// A change of so many percent, certain where `p` is small.
FlightChange made_change(double percent, double p) {
    FlightChange change;
    change.old_variant = "the old one";
    change.new_variant = "the <new> one";
    const double estimate = std::log1p(percent / 100.0);
    change.frames.change = Change{estimate, estimate - 0.01, estimate + 0.01, p};
    change.frames.frames = 28;
    change.frames.old_runs = 3;
    change.frames.new_runs = 4;
    change.frames.old_ms = 10.0;
    change.adjusted_p = p;
    return change;
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
    const std::string page = html_report(recordings, {.first_tables = first_tables});
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
    CHECK(html_report(recordings, {.first_tables = first_tables}) == page);
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
    std::string page = compared_page(recordings);
    CHECK_THAT(page, Contains("2 flights compared"));
    CHECK_THAT(page, Contains("<th>note</th>"));
    CHECK_THAT(page, !Contains("rate</th>"));
    CHECK_THAT(page, Contains("<p class=\"answer\">? cannot tell"));
    CHECK_THAT(page, Contains("<p>note other, compared with note &lt;script&gt;&amp;.</p>"));
    CHECK_THAT(page, Contains("<td class=\"unknown\"><span role=\"img\" aria-label=\"unknown\">?</span> +"));
    CHECK_THAT(page, Contains("<td class=\"number\">1+1</td>") || Contains("<td>1+1</td>"));
    CHECK(page.find("class=\"answer\"") < page.find("sortable matrix"));
    CHECK(page.find("sortable matrix") < page.find("sortable runs"));
    CHECK(count_of(page, "data:image/png;base64,") == 2);
    CHECK(count_of(page, "{\"k\":") == 2 + 2); // both in one plot, and each in its own
    recordings[1].run.settings[1].second = "20";
    page = compared_page(recordings);
    CHECK_THAT(page, Contains("rate</th>"));
    CHECK_THAT(page, Contains("Nothing is compared: no two recordings are of the same flight"));
    CHECK_THAT(page, !Contains("%</td>"));
    recordings[1].name = "one";
    CHECK_THAT(html_report(recordings), Contains((scratch / "two").string()));
    write_file(scratch / "two/report.html", "its own");
    CHECK_THAT(html_report(recordings, {.folder = scratch.path()}), Contains("<a href=\"two/report.html\">"));
}

TEST_CASE("a setting that nothing depends on is no difference, and pauses are told below the tables") {
    const ScratchFolder scratch;
    std::vector recordings{
        made_up_recording(scratch / "one", "first", 5.0), made_up_recording(scratch / "two", "second", 7.0)};
    recordings[0].run.settings.emplace_back("pictures", "5");
    recordings[1].run.settings.emplace_back("pictures", "0");
    recordings[1].run.settings[0].second = "other";
    const std::string page = compared_page(recordings);
    CHECK_THAT(page, Contains("<th>note</th>") && !Contains("<th>pictures</th><th>Frames"));
    CHECK(page.find(">pictures</th>") == page.rfind(">pictures</th>")); // that of the hashes
    CHECK_THAT(page, !Contains("was stopped"));
    FrameRecord paused = made_up_frame(20, 90.0);
    paused.paused = true;
    recordings[0].flight.add(paused);
    CHECK(count_of(compared_page(recordings), "count in no figure and no curve: 1 (column paused") == 2);
    CHECK(count_of(html_report(std::span(recordings).first(1)), "count in no figure and no curve: 1 (column paused") ==
          1);
}

TEST_CASE("a certain change is marked, and a long study stays small") {
    const ScratchFolder scratch;
    const LoadedRecording base = made_up_recording(scratch / "one", "first", 5.0);
    std::vector<LoadedRecording> recordings;
    for (int i = 0; i < 200; ++i) {
        recordings.push_back(base);
        recordings.back().name = "run-" + std::to_string(i);
        recordings.back().run.settings[0].second = i % 2 == 0 ? "old" : "new";
    }
    const auto flights = compared_flights(recordings, &role_on_page);
    std::vector<FlightChange> changes{made_change(11.7, 0.001)};
    changes[0].frames.frames_changed = ChangedFrames{21, 26, 1.0, 0.5};
    changes[0].same_pictures = false;
    const std::string page = html_report(recordings, {.flights = flights, .changes = changes});
    CHECK_THAT(page, Contains("<p class=\"answer\">\u25B2 11.7 % slower (10.6 to 12.8 %); frames 21-26.</p>"));
    CHECK_THAT(
        page, Contains("<td class=\"slower\"><span role=\"img\" aria-label=\"slower\">\u25B2</span> +11.7 %</td>"));
    CHECK_THAT(page, Contains("\u25B2</span> +11.7 % (+10.6 to +12.8 %)</td><td>frames 21-26; other pictures</td>"));
    CHECK_THAT(page, Contains("the &lt;new&gt; one") && Contains("(12 of 200 runs)"));
    const std::size_t overlaid = page.find("plot-list");
    REQUIRE(overlaid != std::string::npos);
    const std::string curves = page.substr(overlaid, page.find("</script>", overlaid) - overlaid);
    CHECK_THAT(curves, Contains("{\"k\":10,") && Contains("{\"k\":11,") && !Contains("{\"k\":12,"));
    CHECK(count_of(page, "{\"k\":") == 12 + 200);
    CHECK(count_of(page, "data:image/png;base64,") == 24);
    CHECK(page.size() < 3'000'000);
    changes[0] = made_change(1.5, 0.5); // 0.5 to 2.5 %, which does not exclude 2 %
    CHECK_THAT(html_report(recordings, {.flights = flights, .changes = changes}),
        Contains("aria-label=\"unknown\">?</span> +1.5 %"));
    changes[0] = made_change(0.5, 0.5);
    CHECK_THAT(html_report(recordings, {.flights = flights, .changes = changes}),
        Contains("aria-label=\"no-change\">=</span> +0.5 %"));
}

TEST_CASE("the answer counts changes, and the matrix has variants in rows as they were given") {
    const ScratchFolder scratch;
    const LoadedRecording base = made_up_recording(scratch / "one", "first", 5.0);
    std::vector<LoadedRecording> recordings;
    const auto add = [&](const std::string& variant, const std::string& flight) {
        for (int repeat = 0; repeat < 2; ++repeat) {
            recordings.push_back(base);
            recordings.back().name = variant + flight + std::to_string(repeat);
            recordings.back().run.title = flight.substr(0, 4);
            recordings.back().run.settings = {{"note", variant}, {"path", flight}};
        }
    };
    for (const char* variant : {"z", "b", "a"}) { add(variant, "east"); }
    for (const char* variant : {"z", "b"}) { add(variant, "west"); }
    add("z", "repeats only");
    std::vector<FlightChange> changes{made_change(10.0, 0.01), made_change(-10.0, 0.01), made_change(0.0, 0.9)};
    std::vector<ComparedFlight> flights = compared_flights(recordings, &role_on_page);
    const std::string page = html_report(recordings, {.flights = flights, .changes = changes});
    CHECK_THAT(page, Contains("2 of 3 variants changed, geometric mean -0.3 %.")); // 1.1 * 0.9 * 1 is 0.9967 cubed
    CHECK_THAT(page, Contains("\u25B2 1 slower, \u25BC 1 faster, = 1 without a change, ? 0 that cannot be told."));
    const std::string matrix = page.substr(page.find("sortable matrix"), 1200);
    CHECK_THAT(matrix, Contains("<th>variant</th><th>east</th><th>west</th></tr>"));
    CHECK_THAT(
        matrix, Contains("<tr><td>note z</td><td class=\"soft\">10.000 ms</td><td class=\"soft\">10.000 ms</td></tr>"));
    CHECK(matrix.find("note z") < matrix.find("note b"));
    CHECK(matrix.find("note b") < matrix.find("note a"));
    for (int i = 0; i < 30; ++i) {
        add("z", fmt::format("same title {}", i));
        add("b", fmt::format("same title {}", i));
        changes.push_back(made_change(0.0, 0.9));
    }
    flights = compared_flights(recordings, &role_on_page);
    const std::string turned = html_report(recordings, {.flights = flights, .changes = changes});
    CHECK_THAT(turned, Contains("<thead><tr><th>flight</th><th>note z</th><th>note b</th><th>note a</th>"));
    CHECK_THAT(turned, Contains("<td>same, path same title 7</td>"));
}

TEST_CASE("a long table is data for the page's script, which no text ends") {
    ResultTable table;
    for (int i = 0; i < 150; ++i) { table.add({{"name", i == 149 ? "</script>\xFF" : "a"}, {"n", i}}); }
    table.rows[140][0].link = "x y";
    table.rows[141][0].css_class = "slower";
    const std::string html = html_of(table, {"sortable", 100});
    CHECK(count_of(html, "<tr><td>") == 100);
    CHECK(count_of(html, "</script>") == 1);
    CHECK_THAT(html, Contains("{\"classes\":[\" \",\"number \"],\"rows\":[[\"a\",\"0\"],\n[\"a\",\"1\"],"));
    CHECK_THAT(html, Contains("[\"\\u003c/script>\uFFFD\",\"149\"]]}</script>"));
    CHECK_THAT(html, Contains("[[\"a\",\"\",\"x y\"],\"140\"],\n[[\"a\",\"slower\",\"\"],\"141\"]"));
    CHECK_THAT(html, Contains("The first 100 of 150 rows") && !Contains("rows are printed"));
    CHECK_THAT(html_of(table, {"sortable"}), !Contains("<script"));
}

TEST_CASE("several recordings keep little but their frame times") {
    const ScratchFolder scratch;
    const std::vector<std::filesystem::path> folders{scratch / "one", scratch / "two"};
    for (const auto& folder : folders) { made_up_recording(folder, "t", 5.0); }
    const std::vector<LoadedRecording> both = load_recordings(folders);
    const LoadedRecording whole = load_recordings(std::span(folders).first(1)).front();
    REQUIRE(both.size() == 2);
    CHECK(both[1].name == "two");
    CHECK(both[0].statistics == whole.statistics);
    CHECK(both[0].flight.frames() == 30);
    CHECK(both[0].flight.end_s() == whole.flight.end_s());
    CHECK(both[0].flight.frame_ms.series().y == whole.flight.frame_ms.series().y);
    CHECK(both[0].flight.times().counts().empty());
    CHECK_FALSE(whole.flight.times().counts().empty());
    Curve curve;
    for (int i = 0; i < 5000; ++i) { curve.add(i, i == 777 ? 9.0 : i % 2); }
    curve.thin(20);
    const PlotSeries few = curve.series();
    CHECK(few.x.size() <= 40);
    CHECK(*std::ranges::max_element(few.y) == 9.0);
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

TEST_CASE("flights of other states are compared by their medians, and the page says so") {
    const ScratchFolder scratch;
    std::vector<LoadedRecording> recordings;
    for (int i = 0; i < 6; ++i) {
        recordings.push_back(made_up_recording(scratch / std::to_string(i), "t", i < 3 ? 5.0 : 7.0 + 0.1 * i));
        recordings.back().run.settings[0].second = i < 3 ? "old" : "new";
    }
    std::string page = compared_page(recordings);
    CHECK_THAT(page, Contains("<h1>6 flights compared</h1>") && !Contains("by medians") && !Contains("By medians"));
    CHECK_THAT(page, Contains("Flights that did not alternate have a wider interval"));
    CHECK_THAT(page, Contains("{\"k\":5,\"g\":\"note new\",\"c\":")); // an entry of the key for each variant
    for (int i = 3; i < 6; ++i) { recordings[static_cast<std::size_t>(i)].run.state_hash = "0123456789abcdef"; }
    page = compared_page(recordings);
    CHECK_THAT(page, Contains("<td>by medians; other states</td>") && Contains("By medians: the frames are not the"));
    CHECK_THAT(page, !Contains("no frames"));
    recordings.resize(3);
    CHECK_THAT(compared_page(recordings), Contains("<h1>3 flights</h1>") && !Contains("\"g\":"));
}

TEST_CASE("a page shows the pictures that its first tables link to, and frame times to readers without script") {
    const ScratchFolder scratch;
    const std::vector recordings{
        made_up_recording(scratch / "one", "t", 5.0), made_up_recording(scratch / "two", "t", 5.0)};
    std::vector<ResultTable> tables(1);
    tables[0].add({{"flight", "turn"}, {"old", "picture-00003.png"}});
    tables[0].rows[0][1].link = "one/picture-00003.png";
    const std::string page = html_report(recordings, {.first_tables = tables, .folder = scratch.path()});
    CHECK_THAT(page, Contains("<figcaption>turn, old</figcaption>"));
    CHECK(count_of(page, "data:image/png;base64,") == 1 + 2);
    const std::string of_one = html_report(std::span(recordings).first(1));
    CHECK(count_of(of_one, "<noscript>") == 5);
    CHECK(count_of(of_one, "<figure><svg") == 1); // of the frame times
}
