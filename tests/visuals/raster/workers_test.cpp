#include "visuals/raster/workers.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>
#include <semaphore>
#include <thread>
#include <vector>

namespace octant::visuals::raster {

TEST_CASE("each task of each run is done once, before the run returns") {
    for (const int threads : {1, 2, 7}) {
        Workers workers(threads);
        CHECK(workers.threads() == threads);
        for (int run = 0; run < 500; ++run) {
            const int tasks = run % 13;
            std::vector<int> done(static_cast<std::size_t>(tasks), 0);
            std::atomic<bool> knows_thread = true;
            workers.run(tasks, [&](int task, int thread) {
                ++done[static_cast<std::size_t>(task)];
                knows_thread = knows_thread && thread >= 0 && thread < threads;
            });
            REQUIRE(std::accumulate(done.begin(), done.end(), 0) == tasks);
            REQUIRE(knows_thread);
        }
    }
}

TEST_CASE("work beside loops is done once, by a helper, and loops do not wait for it") {
    CHECK_FALSE(Workers(1).begin_on_idle_thread([] {}));
    const auto cores = static_cast<int>(std::thread::hardware_concurrency());
    std::atomic<int> done = 0;
    {
        Workers workers(std::max(cores, 2));
        for (int round = 1; round <= 200; ++round) {
            std::binary_semaphore may_end(0);
            REQUIRE(workers.begin_on_idle_thread([&] {
                may_end.acquire();
                ++done;
                done.notify_all();
            }));
            std::atomic<int> tasks = 0;
            workers.run(9, [&](int, int) { ++tasks; });
            REQUIRE(tasks == 9);
            REQUIRE(done == round - 1);
            may_end.release();
            done.wait(round - 1);
        }
        for (int i = 0; i < 5; ++i) {
            workers.begin_on_idle_thread([&] { ++done; });
        }
    }
    CHECK(done == 205);
}

} // namespace octant::visuals::raster
