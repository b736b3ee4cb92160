#include "ui/report/machine_info.h"

#include "sim/base/text_file.h"
#include "sim/base/thread_pool.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <string_view>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

namespace octant::ui::report {

namespace {

/// The file's text, empty when there is none. Files of /proc have no size, hence the stream.
std::string text_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// What follows `key` and its separator on the first line that starts with it.
std::string value_of(std::string_view text, std::string_view key, char separator) {
    for (const std::string_view line : split_lines(text)) {
        if (!line.starts_with(key)) { continue; }
        const std::size_t at = line.find(separator);
        if (at == std::string_view::npos) { continue; }
        std::string_view value = line.substr(at + 1);
        value.remove_prefix(std::min(value.find_first_not_of(" \t\""), value.size()));
        return std::string(value.substr(0, value.find_last_not_of(" \t\"") + 1));
    }
    return {};
}

std::string or_unknown(const std::string& text) { return text.empty() ? "unknown" : text; }

std::uint64_t count_from(std::string_view text) {
    const auto value = whole_number(text);
    return value && *value > 0 ? static_cast<std::uint64_t>(*value) : 0;
}

std::uint64_t own_ticks() {
    const double ticks_per_s = static_cast<double>(sysconf(_SC_CLK_TCK));
    double used_s = 0.0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage use{};
        getrusage(who, &use);
        used_s += static_cast<double>(use.ru_utime.tv_sec + use.ru_stime.tv_sec);
        used_s += 1e-6 * static_cast<double>(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
    }
    return static_cast<std::uint64_t>(used_s * ticks_per_s);
}

std::string compiler_text() {
#if defined(__clang__)
    constexpr std::string_view name = "clang";
#else
    constexpr std::string_view name = "g++";
#endif
#if defined(__OPTIMIZE__)
    constexpr std::string_view how = "optimised";
#else
    constexpr std::string_view how = "not optimised";
#endif
    return fmt::format("{} {}, {}", name, __VERSION__, how);
}

} // namespace

CpuTimes read_cpu_times(const std::filesystem::path& root) {
    // cpu  user nice system idle iowait irq softirq steal ...
    const std::string text = text_of(root / "proc/stat");
    const auto lines = split_lines(text);
    const auto words = lines.empty() ? std::vector<std::string_view>{} : split_words(lines.front());
    CpuTimes times;
    if (words.size() < 9 || words.front() != "cpu") { return times; }
    for (std::size_t i = 1; i <= 8; ++i) { times.total += count_from(words[i]); }
    times.idle = count_from(words[4]) + count_from(words[5]);
    times.steal = count_from(words[8]);
    times.own = own_ticks();
    return times;
}

MachineInfo read_machine_info(std::chrono::system_clock::time_point start, const std::filesystem::path& root) {
    MachineInfo info;
    info.cpu = or_unknown(value_of(text_of(root / "proc/cpuinfo"), "model name", ':'));
    info.cores = core_count();
    const std::string memory = value_of(text_of(root / "proc/meminfo"), "MemTotal", ':');
    info.memory_kb = count_from(memory.substr(0, memory.find(' ')));
    info.os = or_unknown(value_of(text_of(root / "etc/os-release"), "PRETTY_NAME", '='));
    utsname names{};
    const bool named = uname(&names) == 0;
    info.kernel = named ? fmt::format("{} {}", names.sysname, names.release) : "unknown";
    const char* const node = std::getenv("SLURMD_NODENAME");
    info.host = node != nullptr ? node : (named ? names.nodename : "unknown");
    info.compiler = compiler_text();
    const char* threads = std::getenv("LP_NUM_THREADS");
    info.lp_num_threads = threads != nullptr ? threads : "not set";
    info.start_time_utc = utc_text(start);
    const std::string load = text_of(root / "proc/loadavg");
    info.load_average_1min = finite_number(load.substr(0, load.find(' '))).value_or(0.0);
    info.cpu_times = read_cpu_times(root);
    return info;
}

std::optional<CpuUse> cpu_use_between(const CpuTimes& start, const CpuTimes& end) {
    if (end.total <= start.total || end.idle < start.idle || end.steal < start.steal) { return std::nullopt; }
    const auto share_of = [total = static_cast<double>(end.total - start.total)](
                              double ticks) { return std::clamp(ticks / total, 0.0, 1.0); };
    const auto stolen = static_cast<double>(end.steal - start.steal);
    const auto idle = static_cast<double>(end.idle - start.idle);
    const auto own = static_cast<double>(end.own) - static_cast<double>(start.own);
    const auto all = static_cast<double>(end.total - start.total);
    return CpuUse{share_of(stolen), share_of(all - idle - stolen - own)};
}

std::vector<std::string> noise_reasons(double load_average_1min, int cores, const std::optional<CpuUse>& during) {
    std::vector<std::string> reasons;
    if (!during) {
        if (load_average_1min > noisy_load_per_core * cores) {
            reasons.push_back(fmt::format(
                "The load average was {:.2f} on {} cores when the flight began.", load_average_1min, cores));
        }
        return reasons;
    }
    if (during->stolen > noisy_steal_share) {
        reasons.push_back(fmt::format("{:.1f} % of the processor time was stolen.", 100.0 * during->stolen));
    }
    if (during->others > noisy_others_share) {
        reasons.push_back(fmt::format("Other programs used {:.1f} % of the processor time.", 100.0 * during->others));
    }
    return reasons;
}

std::string utc_text(std::chrono::system_clock::time_point time) {
    const auto day = std::chrono::floor<std::chrono::days>(time);
    const std::chrono::year_month_day date(day);
    const std::chrono::hh_mm_ss clock(std::chrono::floor<std::chrono::milliseconds>(time - day));
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
        static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), clock.hours().count(),
        clock.minutes().count(), clock.seconds().count(), clock.subseconds().count());
}

} // namespace octant::ui::report
