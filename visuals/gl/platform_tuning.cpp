#include "visuals/gl/platform_tuning.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <malloc.h>
#include <optional>
#include <sched.h>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace octant::visuals::gl {
namespace {

std::optional<int> number_in(std::string_view text) {
    int number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    return fault == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Kernel's numbers of the threads that Mesa named "llvmpipe-0", "llvmpipe-1", ...
std::vector<pid_t> raster_threads() {
    std::vector<pid_t> threads;
    std::error_code fault;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", fault)) {
        std::string name;
        std::getline(std::ifstream(task.path() / "comm"), name);
        const std::optional<int> id = number_in(task.path().filename().string());
        if (name.starts_with("llvmpipe-") && id) { threads.push_back(*id); }
    }
    return threads;
}

/// Processors that this process may use.
std::vector<int> allowed_cpus() {
    std::vector<int> processors;
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) {
        for (int i = 0; i < CPU_SETSIZE; ++i) {
            if (CPU_ISSET(static_cast<unsigned>(i), &allowed)) { processors.push_back(i); }
        }
    }
    return processors;
}

} // namespace

void tune_allocator() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    mallopt(M_TOP_PAD, 16 << 20);
#endif
}

int spread_raster_threads() {
    const std::vector<pid_t> threads = raster_threads();
    const std::vector<int> processors = allowed_cpus();
    if (processors.empty() || processors.size() > threads.size()) { return 0; }
    int placed = 0;
    for (std::size_t i = 0; i < threads.size(); ++i) {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(static_cast<unsigned>(processors[i % processors.size()]), &one);
        placed += sched_setaffinity(threads[i], sizeof one, &one) == 0 ? 1 : 0;
    }
    return placed;
}

} // namespace octant::visuals::gl
