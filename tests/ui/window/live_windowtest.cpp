#include "sim/links/flightgear_fdm.h"
#include "sim/links/udp_port.h"
#include "tests/ui/window/virtual_display.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/replay.h"
#include "ui/settings/settings_file.h"
#include "ui/window/viewer.h"

#include <catch2/catch.hpp>
#include <imgui.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <imgui_internal.h>
#include <string>
#include <thread>
#include <unistd.h>

using namespace octant;

namespace {

namespace fs = std::filesystem;
namespace links = sim::links;

/// Somebody who sends FDM packets to a port of this machine while this object lives: a turn at 100 m/s.
class FdmSender {
public:
    explicit FdmSender(std::uint16_t port)
        : thread_([this, port] {
              constexpr std::uint32_t loopback = 0x7f000001;
              links::UdpPort socket(loopback, 0);
              const auto begin = std::chrono::steady_clock::now();
              while (!done_) {
                  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
                  socket.send({loopback, port}, links::encode_fdm(fix_at(passed.count())));
                  std::this_thread::sleep_for(std::chrono::milliseconds(16));
              }
          }) {}

    ~FdmSender() {
        done_ = true;
        thread_.join();
    }

    FdmSender(const FdmSender&) = delete;
    FdmSender& operator=(const FdmSender&) = delete;
    FdmSender(FdmSender&&) = delete;
    FdmSender& operator=(FdmSender&&) = delete;

private:
    static links::Fix fix_at(double time_s) {
        links::Fix fix;
        fix.latitude_deg = 47.0 + 100.0 * time_s / 111177.0;
        fix.longitude_deg = 8.0;
        fix.altitude_m = 1000.0;
        fix.above_ground_m = 300.0;
        fix.attitude.roll_rad = 0.3 * time_s;
        fix.velocity_ned_mps = glm::dvec3(100.0, 0.0, 0.0);
        fix.ticks = static_cast<std::uint32_t>(time_s * 1e6);
        return fix;
    }

    std::atomic<bool> done_ = false;
    std::thread thread_;
};

/// What a replay without a window says of a recording.
ui::flight::ReplayComparison replayed(const fs::path& folder) {
    const ui::flight::Replay replay = ui::flight::read_replay(folder);
    const ui::settings::RunSettings settings = ui::settings::read_settings(folder / "run.json");
    ui::flight::Session session(settings);
    ui::flight::FlightRecorder recorder({}, settings, session);
    const auto packets = ui::flight::replay_packets(replay, session, recorder, true);
    const ui::flight::FlightResult end = recorder.finish(session);
    return ui::flight::compare_with_recording(replay, end.state_hash, end.picture_hash);
}

} // namespace

TEST_CASE("a flight of others that is recorded in the window is replayed without one") {
    const auto display = tests::VirtualDisplay::start();
    if (!display) {
        std::puts("SKIPPED: Xvfb is not installed");
        return;
    }
    const fs::path folder = fs::temp_directory_path() / ("octant-live-window-" + std::to_string(getpid()));
    fs::remove_all(folder);
    constexpr std::uint32_t loopback = 0x7f000001;
    const std::uint16_t port = links::UdpPort(loopback, 0).port();
    {
        ui::window::ViewOptions options;
        options.settings.view.size_px = {480, 320};
        options.settings.path.terrain = "hills";
        options.settings.path.aircraft = {"f15", "f15"};
        options.panels = false;
        options.vsync = false;
        options.record = folder;
        ui::flight::ListenerOptions listener;
        listener.input.fdm_port = port;
        listener.input.is_channel = true; // opens no other ports
        listener.input.cigi_port = -1;
        options.listener = listener;
        ui::window::Viewer viewer(options);
        const FdmSender sender(port);
        for (int i = 0; i < 90; ++i) {
            viewer.run_frame();
            viewer.state().next_settings.view.azimuth_deg = i; // A recording keeps its view.
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        const ImGuiWindow* const marks = ImGui::FindWindowByName("##status"); // "REC folder"
        REQUIRE(marks != nullptr);
        CHECK(marks->Pos.y > 160.0F); // The picture's own words are above.
        CHECK(marks->Pos.y + marks->Size.y <= 320.0F);
        REQUIRE(viewer.finish_recording());
        CHECK_FALSE(viewer.finish_recording());
        viewer.run_frame(); // goes on
        viewer.run_frame();
    }
    const ui::flight::ReplayComparison verdict = replayed(folder);
    INFO(verdict.line);
    CHECK(verdict.is_same);
    CHECK(fs::exists(folder / "report.html"));
    fs::remove_all(folder);
}
