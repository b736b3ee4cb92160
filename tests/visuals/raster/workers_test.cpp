#include "visuals/raster/workers.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <cstddef>
#include <numeric>
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

} // namespace octant::visuals::raster
