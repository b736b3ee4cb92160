#pragma once

#include "sim/base/worker_team.h"

#include <algorithm>
#include <cstddef>
#include <thread>

namespace octant::models::made {

/// Calls work(row) once for each row below `rows`, in any order, on all cores. Rows must not read
/// what others write, so that the result is the same on however many.
template <typename Work>
void by_rows(int rows, const Work& work) {
    const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    share_out(
        static_cast<std::size_t>(rows), threads, [&](std::size_t row, std::size_t /*worker*/) {
            work(static_cast<int>(row));
        });
}

} // namespace octant::models::made
