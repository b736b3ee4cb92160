#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace octant {

/// How many threads this machine runs at once, at least 1.
inline int core_count() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

/// Calls `work(index, worker)` once for each index below `count`, in any order, on `threads` threads (this one among
/// them, numbered from 0). The first exception ends the work and is thrown here.
template <typename Work>
void parallel_for(std::size_t count, int threads, const Work& work) {
    std::atomic<std::size_t> next = 0;
    std::exception_ptr failure;
    std::mutex failing;
    const auto run = [&](std::size_t worker) {
        try {
            for (std::size_t index = next++; index < count; index = next++) { work(index, worker); }
        } catch (...) {
            next = count;
            const std::scoped_lock lock(failing);
            failure = failure ? failure : std::current_exception();
        }
    };
    {
        std::vector<std::jthread> helpers;
        const std::size_t wanted = std::min<std::size_t>(count, static_cast<std::size_t>(threads));
        for (std::size_t worker = 1; worker < wanted; ++worker) { helpers.emplace_back(run, worker); }
        run(0);
    }
    if (failure) { std::rethrow_exception(failure); }
}

/// Calls `work(row)` once for each row below `rows`, in any order, on all cores. Rows must not read what others write,
/// so that the result is the same on however many.
template <typename Work>
void by_rows(int rows, const Work& work) {
    parallel_for(static_cast<std::size_t>(rows), core_count(),
        [&](std::size_t row, std::size_t) { work(static_cast<int>(row)); });
}

} // namespace octant
