#include "sim/base/thread_pool.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <numeric>
#include <semaphore>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace octant {

TEST_CASE("each task of each run is done once, before the run returns") {
    for (const int threads : {1, 2, 7}) {
        ThreadPool pool(threads);
        CHECK(pool.threads() == threads);
        for (int run = 0; run < 500; ++run) {
            const int tasks = run % 13;
            std::vector<int> done(static_cast<std::size_t>(tasks), 0);
            std::atomic<bool> knows_thread = true;
            pool.run(tasks, [&](int task, int thread) {
                ++done[static_cast<std::size_t>(task)];
                knows_thread = knows_thread && thread >= 0 && thread < threads;
            });
            REQUIRE(std::accumulate(done.begin(), done.end(), 0) == tasks);
            REQUIRE(knows_thread);
        }
    }
}

TEST_CASE("a function on an idle thread is done once, by a helper, and loops do not wait for it") {
    CHECK_FALSE(ThreadPool(1).begin_on_idle_thread([] {}));
    const auto cores = static_cast<int>(std::thread::hardware_concurrency());
    std::atomic<int> done = 0;
    {
        ThreadPool pool(std::max(cores, 2));
        for (int round = 1; round <= 200; ++round) {
            std::binary_semaphore may_end(0);
            REQUIRE(pool.begin_on_idle_thread([&] {
                may_end.acquire();
                ++done;
                done.notify_all();
            }));
            std::atomic<int> tasks = 0;
            pool.run(9, [&](int, int) { ++tasks; });
            REQUIRE(tasks == 9);
            REQUIRE(done == round - 1);
            may_end.release();
            done.wait(round - 1);
        }
        for (int i = 0; i < 5; ++i) {
            pool.begin_on_idle_thread([&] { ++done; });
        }
    }
    CHECK(done == 205);
}

TEST_CASE("the first exception of a loop ends it and is thrown to the caller") {
    for (const int threads : {1, 3}) {
        std::atomic<int> done = 0;
        const auto work = [&](std::size_t index, std::size_t) {
            if (index == 20) { throw std::runtime_error("twenty"); }
            ++done;
        };
        CHECK_THROWS_WITH(parallel_for(100000, threads, work), "twenty");
        CHECK(done < 100000 - 1);
        CHECK(done >= 20 - (threads - 1));
    }
}

TEST_CASE("of two functions that both throw the first one's exception is told") {
    const auto first = []() -> int { throw std::runtime_error("first"); };
    const auto second = []() -> int { throw std::runtime_error("second"); };
    for (const bool on_two_threads : {false, true}) {
        CHECK_THROWS_WITH(run_both(on_two_threads, first, second), "first");
    }
    CHECK(run_both(
              true, [] { return 1; }, [] { return 2; }) == std::pair(1, 2));
}

TEST_CASE("a background task runs on a pool's thread or its own, and gives its exception to the one who waits") {
    ThreadPool pool(2);
    const IdleThreadRunner runners[] = {nullptr, [](auto&&) { return false; },
        [&](std::function<void()> work) {
            pool.begin(std::move(work));
            return true;
        }};
    for (const IdleThreadRunner& runner : runners) {
        BackgroundTask task;
        std::binary_semaphore may_end(0);
        int done = 0;
        task.begin(
            [&] {
                may_end.acquire();
                ++done;
            },
            runner);
        CHECK(task.is_running());
        may_end.release();
        task.wait();
        CHECK(done == 1);
        CHECK_FALSE(task.is_running());
        task.begin([] { throw std::runtime_error("failed"); }, runner);
        CHECK_THROWS_WITH(task.wait(), "failed");
        task.begin([&] { ++done; }, runner);
        task.wait();
        CHECK(done == 2);
    }
}

} // namespace octant
