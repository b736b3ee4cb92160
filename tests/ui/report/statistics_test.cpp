#include "sim/base/nearest_rank.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/statistics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <numeric>

using namespace octant::ui::report;

TEST_CASE("no frames give zeros, and one frame has no deviation and no jitter") {
    CHECK(statistics_of({}) == Statistics{});
    for (const Statistic& statistic : all_statistics()) {
        CHECK(statistic_text(statistic, {}) == (statistic.decimals == 0 ? "0" : "-"));
    }
    const std::array one{20.0};
    const Statistics got = statistics_of_times(one);
    CHECK(got.frames == 1);
    CHECK(got.mean_ms == 20.0);
    CHECK(got.sd_ms == 0.0);
    CHECK(got.p50_ms == 20.0);
    CHECK(got.p999_ms == 20.0);
    CHECK(got.max_ms == 20.0);
    CHECK(got.low_1pct_fps == 50.0);
    CHECK(got.low_01pct_fps == 50.0);
    CHECK(got.overruns_16ms == 1);
    CHECK(got.overruns_33ms == 0);
    CHECK(got.jitter_ms == 0.0);
}

TEST_CASE("five frames give the figures worked out by hand") {
    const std::array times{10.0, 40.0, 20.0, 50.0, 30.0};
    const Statistics got = statistics_of_times(times);
    CHECK(got.mean_ms == 30.0);
    CHECK(got.sd_ms == Approx(15.811388)); // sqrt(1000 / 4)
    CHECK(got.p50_ms == 30.0);             // rank 3
    CHECK(got.p90_ms == 50.0);             // rank ceil(4.5)
    CHECK(got.max_ms == 50.0);
    CHECK(got.low_1pct_fps == 20.0);
    CHECK(got.overruns_16ms == 4);
    CHECK(got.overruns_33ms == 2);
    CHECK(got.overruns_41ms == 1);
    CHECK(got.jitter_ms == 25.0); // (30 + 20 + 30 + 20) / 4
}

TEST_CASE("an overrun is longer than its limit, not as long") {
    const std::array times{16.67, 33.3, 41.7};
    const Statistics got = statistics_of_times(times);
    CHECK(got.overruns_16ms == 2);
    CHECK(got.overruns_33ms == 1);
    CHECK(got.overruns_41ms == 0);
}

TEST_CASE("nearest ranks of 1 to 1000 are exact") {
    std::vector<double> sorted(1000);
    std::iota(sorted.begin(), sorted.end(), 1.0);
    const std::vector<double> few(sorted.begin(), sorted.begin() + 101);
    for (const int permille : {500, 990, 999, 1000}) {
        CHECK(octant::nearest_rank(std::vector<double>(sorted.rbegin(), sorted.rend()), permille) == permille);
    }
    CHECK(octant::nearest_rank(std::vector<double>(few.rbegin(), few.rend()), 990) == 100.0); // ceil(99.99)
    CHECK(octant::nearest_rank(std::vector<double>(), 500) == 0.0);
    const Statistics got = statistics_of_times(sorted);
    CHECK(got.low_1pct_fps == Approx(1000.0 / 995.5)); // mean of 991 to 1000
    CHECK(got.low_01pct_fps == 1.0);
}

TEST_CASE("warm-up frames are left out of the figures") {
    std::vector<FrameRecord> records{made_up_frame(0, 500.0), made_up_frame(1, 500.0), made_up_frame(2, 6.5)};
    CHECK(statistics_of(records).frames == 1);
    CHECK(statistics_of(records).max_ms == 10.0);
}

TEST_CASE("frames in which the program was stopped are left out of the figures and are never among the slowest") {
    std::vector<FrameRecord> records{made_up_frame(2, 4.5), made_up_frame(3, 90.0), made_up_frame(4, 5.5)};
    records[1].paused = true;
    const Statistics figures = statistics_of(records);
    CHECK(figures.frames == 2);
    CHECK(figures.max_ms == 9.0);
    CHECK(figures.overruns_16ms == 0);
    CHECK(figures.jitter_ms == 1.0);
    SlowFrameList slow;
    for (const FrameRecord& record : records) { slow.add(record); }
    CHECK(slow.slowest().size() == 2);
    CHECK(slow.slowest().front().record.frame == 4);
}

TEST_CASE("the figures are named as run.json names them") {
    std::vector<std::string> keys;
    for (const Statistic& statistic : all_statistics()) { keys.emplace_back(statistic.key); }
    CHECK(keys == std::vector<std::string>{"frames", "mean_ms", "sd_ms", "p50_ms", "p90_ms", "p95_ms", "p99_ms",
                      "p999_ms", "max_ms", "low_1pct_fps", "low_01pct_fps", "overruns_16ms", "overruns_33ms",
                      "overruns_41ms", "jitter_ms"});
}

TEST_CASE("an overrun names the longest stage and the one that grew") {
    std::vector<FrameRecord> records;
    for (int frame = 0; frame < 7; ++frame) { records.push_back(made_up_frame(frame, 10.0)); }
    records[5].plan_ms = 9.0;
    records[5].frame_ms = 21.0; // 0.5 ms of it in no stage
    SlowFrameList slow;
    std::ranges::for_each(records, [&](const FrameRecord& each) { slow.add(each); });
    const auto overruns = slow.slowest();
    REQUIRE(overruns.size() == 5);
    CHECK(slow.above_16_ms() == std::array<int, 5>{0, 0, 1, 0, 0});
    CHECK(overruns[0].record.frame == 5);
    CHECK(stage_names[overruns[0].longest_stage] == "draw");
    CHECK(stage_names[overruns[0].slowed_stage] == "plan");
    CHECK(overruns[0].slowdown_ms == 7.0);
    CHECK(overruns[0].stage_ms[4] == Approx(0.5));
}
