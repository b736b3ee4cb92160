#include "tests/ui/commands/cigi_bench.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace octant::tests {

namespace links = sim::links;

void CigiBench::send(const links::WireWriter& message) { socket_.send({loopback, generator_}, message.bytes()); }

bool CigiBench::await(const std::function<bool(const StartOfFrame&)>& says) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + std::chrono::seconds(30);
    while (Clock::now() < end) {
        listen();
        if (std::ranges::any_of(heard_, says)) { return true; }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

void CigiBench::listen() {
    std::vector<links::Datagram> packets;
    socket_.drain(links::Protocol::Cigi, 0.0, packets);
    for (const links::Datagram& packet : packets) {
        const links::WireReader reader(packet.bytes, links::ByteOrder::Big);
        if (reader.at<std::uint8_t>(0) == 101) {
            heard_.push_back({reader.at<std::uint32_t>(8), reader.at<std::uint32_t>(12), reader.at<std::uint32_t>(16)});
        }
    }
}

ProgramRun generate_for(CigiBench& host, std::vector<std::string> arguments, const std::function<void()>& host_works) {
    const std::vector<std::string> first{"listen", "--headless", "--ports", "fdm=-1,mavlink=-1,dis=-1,xplane=-1",
        "--ports", "cigi=" + std::to_string(host.generator()), "--cigi",
        "host=127.0.0.1:" + std::to_string(host.port())};
    arguments.insert(arguments.begin(), first.begin(), first.end());
    ProgramRun run;
    std::thread generator([&] { run = run_octant(arguments); });
    host_works();
    generator.join();
    return run;
}

} // namespace octant::tests
