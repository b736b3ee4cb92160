#include "sim/base/stopwatch.h"
#include "ui/base/progress.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <ctime>
#include <thread>

using namespace octant::ui;

TEST_CASE("time without a processor is that of sleeping, not that of work") {
    constexpr double asleep_ms = 40.0;
    constexpr double at_work_ms = 60.0;
    const octant::Stopwatch wall;
    const octant::OffCpuTimer idle;
    const std::clock_t begun = std::clock();
    while (static_cast<double>(std::clock() - begun) * 1e3 / CLOCKS_PER_SEC < at_work_ms) {}
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(asleep_ms));
    const double idle_ms = idle.ms();
    CHECK(idle_ms >= asleep_ms - 1.0);
    CHECK(idle_ms <= wall.ms() - at_work_ms + 1.0);
}

TEST_CASE("progress tells slow steps, too") {
    CHECK(base::rate_text(250.4) == "250");
    CHECK(base::rate_text(10.0) == "10");
    CHECK(base::rate_text(3.43) == "3.4");
    CHECK(base::rate_text(0.0617) == "0.062");
    CHECK(base::rate_text(0.0) == "0");
}
