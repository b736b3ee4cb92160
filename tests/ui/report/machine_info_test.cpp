#include "sim/base/output_file.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/machine_info.h"

#include <catch2/catch.hpp>

using namespace octant;
using namespace octant::ui::report;

TEST_CASE("the machine is read from its files") {
    const ScratchFolder root;
    make_folder(root / "proc");
    make_folder(root / "etc");
    write_file(root / "proc/cpuinfo", "processor\t: 0\nmodel name\t: Fast, 2.5 GHz\nmodel name\t: other\n");
    write_file(root / "proc/meminfo", "MemTotal:       16384 kB\nMemFree: 1 kB\n");
    write_file(root / "proc/loadavg", "1.25 0.50 0.10 1/93 15623\n");
    write_file(root / "proc/stat", "cpu  100 20 30 400 50 6 7 8 0 0\ncpu0 1 2 3 4\n");
    write_file(root / "etc/os-release", "NAME=\"x\"\nPRETTY_NAME=\"Some System 12\"\n");
    const MachineInfo info = read_machine_info({}, root.path());
    CHECK(info.cpu == "Fast, 2.5 GHz");
    CHECK(info.memory_kb == 16384);
    CHECK(info.load_average_1min == 1.25);
    CHECK(info.os == "Some System 12");
    CHECK(info.start_time_utc == "1970-01-01T00:00:00.000Z");
    CHECK(info.cores >= 1);
    CHECK(info.cpu_times.total == 621);
    CHECK(info.cpu_times.idle == 450);
    CHECK(info.cpu_times.steal == 8);
}

TEST_CASE("a machine that says nothing of itself is unknown") {
    const ScratchFolder root;
    const MachineInfo info = read_machine_info({}, root.path());
    CHECK(info.cpu == "unknown");
    CHECK(info.os == "unknown");
    CHECK(info.memory_kb == 0);
    CHECK(info.load_average_1min == 0.0);
    CHECK(info.cpu_times.total == 0);
    CHECK_FALSE(cpu_use_between(info.cpu_times, info.cpu_times));
}

TEST_CASE("processor time is shared between us, others, the host and idling") {
    const auto use = cpu_use_between({1000, 500, 10, 100}, {2000, 900, 30, 500});
    REQUIRE(use);
    CHECK(use->stolen == 0.02);
    CHECK(use->others == 0.18); // 1000 - 400 idle - 20 stolen - 400 ours
}

TEST_CASE("a flight is noisy when steal, others or, lacking these, the load say so") {
    CHECK(noise_reasons(9.0, 2, CpuUse{0.01, 0.10}).empty());
    CHECK(
        noise_reasons(0.0, 2, CpuUse{0.02, 0.5}) == std::vector<std::string>{"2.0 % of the processor time was stolen.",
                                                        "Other programs used 50.0 % of the processor time."});
    CHECK(noise_reasons(1.0, 2, std::nullopt).empty());
    CHECK(noise_reasons(1.5, 2, std::nullopt) ==
          std::vector<std::string>{"The load average was 1.50 on 2 cores when the flight began."});
}

TEST_CASE("a time is written as UTC") {
    using std::chrono::system_clock;
    CHECK(utc_text(system_clock::from_time_t(1767225599)) == "2025-12-31T23:59:59.000Z");
    CHECK(utc_text(system_clock::from_time_t(951782400)) == "2000-02-29T00:00:00.000Z");
    CHECK(utc_text(system_clock::from_time_t(951782400) + std::chrono::microseconds(42999)) ==
          "2000-02-29T00:00:00.042Z");
}
