#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace octant {

/// Calls `work(index, worker)` once for each index below `count`, in any order, on `threads`
/// threads (this one among them, numbered from 0). The first exception ends the work and is thrown
/// here.
template <typename Work>
void share_out(std::size_t count, int threads, const Work& work) {
    std::atomic<std::size_t> next = 0;
    std::exception_ptr failure;
    std::mutex failing;
    const auto run = [&](std::size_t worker) {
        try {
            for (std::size_t index = next++; index < count; index = next++) {
                work(index, worker);
            }
        } catch (...) {
            next = count;
            const std::scoped_lock lock(failing);
            failure = failure ? failure : std::current_exception();
        }
    };
    {
        std::vector<std::jthread> helpers;
        const std::size_t wanted = std::min<std::size_t>(count, static_cast<std::size_t>(threads));
        for (std::size_t worker = 1; worker < wanted; ++worker) {
            helpers.emplace_back(run, worker);
        }
        run(0);
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

} // namespace octant
