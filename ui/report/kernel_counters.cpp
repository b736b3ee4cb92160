#include "ui/report/kernel_counters.h"

#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <fcntl.h>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace octant::ui::report {

namespace {

FrameCounters total_counters() {
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    return {use.ru_minflt + use.ru_majflt, use.ru_nivcsw, 0.0};
}

double tick_ms() { return 1000.0 / static_cast<double>(sysconf(_SC_CLK_TCK)); }

/// A frame's counters from its row; nothing if a field is missing or damaged.
std::optional<std::pair<long, FrameCounters>> counters_from(std::span<const std::string_view> fields) {
    if (fields.size() != 4) { return std::nullopt; }
    const auto frame = whole_number(fields[0]);
    const auto faults = whole_number(fields[1]);
    const auto switches = whole_number(fields[2]);
    const auto stolen_ms = finite_number(fields[3]);
    if (!frame || !faults || !switches || !stolen_ms) { return std::nullopt; }
    return std::pair(*frame, FrameCounters{*faults, *switches, *stolen_ms});
}

} // namespace

KernelCounters::KernelCounters()
    : stat_(::open("/proc/stat", O_RDONLY | O_CLOEXEC)), stolen_ticks_(stolen_ticks()),
      reported_stolen_ticks_(stolen_ticks_), reported_counts_(total_counters()) {}

KernelCounters::~KernelCounters() {
    if (stat_ >= 0) { ::close(stat_); }
}

/// Of all processors together; 0 where the kernel does not say. The first line is
/// cpu  user nice system idle iowait irq softirq steal ...
std::uint64_t KernelCounters::stolen_ticks() {
    constexpr std::size_t place = 8;
    std::array<char, 256> text{};
    const ssize_t read = stat_ < 0 ? 0 : ::pread(stat_, text.data(), text.size(), 0);
    std::string_view line(text.data(), static_cast<std::size_t>(std::max<ssize_t>(read, 0)));
    line = line.substr(0, line.find('\n'));
    const auto words = split_words(line);
    const auto ticks = words.size() > place ? whole_number(words[place]) : std::nullopt;
    since_stolen_ = Stopwatch();
    return ticks && *ticks > 0 ? static_cast<std::uint64_t>(*ticks) : 0;
}

void KernelCounters::begin() { reported_counts_ = total_counters(); }

FrameCounters KernelCounters::lap() {
    const FrameCounters now = total_counters();
    FrameCounters since{now.page_faults - reported_counts_.page_faults, now.switches - reported_counts_.switches, 0.0};
    if (since_stolen_.ms() >= tick_ms()) {
        stolen_ticks_ = std::max(stolen_ticks_, stolen_ticks());
        since.stolen_ms = tick_ms() * static_cast<double>(stolen_ticks_ - reported_stolen_ticks_);
        reported_stolen_ticks_ = stolen_ticks_;
    }
    return since;
}

std::string counters_header() { return "frame,page_faults,switches,stolen_ms\n"; }

std::string counters_line(const FrameRecord& record) {
    const FrameCounters& counters = record.counters;
    return fmt::format("{},{},{},{:.0f}\n", record.frame, counters.page_faults, counters.switches, counters.stolen_ms);
}

CounterReader::CounterReader(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) { return; }
    table_.emplace(TextScanner::of_file(file), ',');
    if (!table_->next_row() || counters_header() != std::string(table_->row()) + "\n") { table_.reset(); }
}

std::optional<std::pair<long, FrameCounters>> CounterReader::next() {
    while (table_ && table_->next_row()) {
        const auto counters = table_->is_truncated() ? std::nullopt : counters_from(table_->fields());
        if (counters) { return counters; }
    }
    return std::nullopt;
}

FrameCounters CounterReader::of(int frame) {
    while (const auto counters = next()) {
        if (counters->first >= frame) { return counters->first == frame ? counters->second : FrameCounters(); }
    }
    return {};
}

bool read_counters(const std::filesystem::path& file, std::span<SlowFrame> frames) {
    CounterReader reader(file);
    while (const auto counters = reader.next()) {
        const auto frame =
            std::ranges::find_if(frames, [&](const SlowFrame& each) { return each.record.frame == counters->first; });
        if (frame != frames.end()) { frame->record.counters = counters->second; }
    }
    return reader.is_there();
}

} // namespace octant::ui::report
