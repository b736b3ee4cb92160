#include "ui/commands/listen.h"

#include "sim/base/error.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/commands/flight_summary.h"
#include "ui/flight/sender.h"
#include "ui/flight/session.h"
#include "ui/report/video_pipe.h"

#include <chrono>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace octant::ui::commands {

namespace {

constexpr double poll_interval_s = 0.0005; ///< in steps, for the next packet

/// What came, for programs: every vehicle, and what its packets were.
base::JsonValue::JsonMembers results_of_run(const sim::links::LiveTraffic& traffic) {
    base::JsonValue vehicles = base::JsonValue::list({});
    for (const sim::links::VehicleReport& vehicle : traffic.vehicle_reports()) {
        vehicles.push_back({{"protocol", std::string(sim::links::name_of(vehicle.protocol))}, {"name", vehicle.name},
            {"marking", vehicle.marking}, {"from", sim::links::text_of(vehicle.source)}, {"packets", vehicle.packets},
            {"latitude_deg", vehicle.latitude_deg}, {"longitude_deg", vehicle.longitude_deg},
            {"altitude_m", vehicle.altitude_m}, {"shown", vehicle.is_shown}});
    }
    base::JsonValue packets = base::JsonValue::list({});
    for (const sim::links::PacketReport& form : traffic.packet_reports()) {
        packets.push_back({{"from", sim::links::text_of(form.source)}, {"what", form.text}, {"packets", form.packets},
            {"refused", form.is_wrong}});
    }
    return {{"vehicles", std::move(vehicles)}, {"packets", std::move(packets)},
        {"packets_untold", traffic.counts().untold}};
}

/// A flight from outside, picture after picture, at the rate of the settings by the clock.
class HeadlessListener {
public:
    explicit HeadlessListener(const ListenOptions& options)
        : options_(options), listener_(options.listener), sender_(options.send), session_(options.settings),
          recorder_(options.record, options.settings, session_) {
        listener_.attach(session_);
        if (options.record.folder) { listener_.start_packet_recording(*options.record.folder); }
    }

    flight::FlightResult fly() {
        print_new_messages();
        const double frame_s = 1.0 / options_.settings.time.rate_hz;
        began_s_ = listener_.now_s();
        double due_s = began_s_;
        const bool step = options_.listener.live.step;
        int frame = 0;
        while (!base::StopSignals::received() && !is_over(frame)) {
            wait_until(step ? listener_.now_s() + poll_interval_s : due_s);
            const bool drawn = draw(due_s + frame_s);
            frame += drawn ? 1 : 0;
            due_s = std::max(due_s + frame_s, listener_.now_s() - frame_s);
            if (listener_.has_ended() && !(step && drawn)) { break; }
        }
        if (base::StopSignals::received()) {
            base::print_note(
                options_.quiet, fmt::format("note: ended by {} after {} pictures", base::StopSignals::name(), frame));
        }
        listener_.finish();
        return recorder_.finish(session_);
    }

    const sim::links::LiveTraffic& traffic() const { return listener_.live().traffic(); }

private:
    bool is_over(int frame) const {
        const settings::TimeSettings& time = options_.settings.time;
        return (time.frames && frame >= *time.frames) ||
               (time.seconds && frame > 0 && listener_.now_s() - began_s_ >= *time.seconds);
    }

    void wait_until(double due_s) const {
        const double left_s = due_s - listener_.now_s();
        if (left_s > 0.0) { std::this_thread::sleep_for(std::chrono::duration<double>(left_s)); }
    }

    /// Returns false where there is nothing to draw.
    bool draw(double next_due_s) {
        const std::optional<double> time_s = listener_.take(session_);
        for (const std::string& line : listener_.take_new_messages()) { base::print_note(options_.quiet, line); }
        if (!time_s) {
            listener_.contact_hosts();
            return false;
        }
        report::FrameRecord record = session_.draw_at(*time_s, std::nullopt);
        listener_.finish_picture(record);
        if (options_.listener.live.step) {
            record.latency_ms = std::numeric_limits<double>::quiet_NaN();
        } else {
            record.missed = listener_.now_s() > next_due_s ? 1 : 0;
        }
        sender_.send(session_);
        recorder_.add(record, session_);
        return true;
    }

    void print_new_messages() const {
        for (const std::string& note : session_.world().notes) {
            base::print_note(options_.quiet, fmt::format("note: {}", note));
        }
    }

    const ListenOptions& options_;
    flight::Listener listener_;
    flight::Sender sender_;
    flight::Session session_;
    /// From here on a signal ends the flight in order: the recorder makes files.
    const base::StopSignals stop_signals_;
    flight::FlightRecorder recorder_;
    double began_s_ = 0.0;
};

} // namespace

void listen_without_window(const ListenOptions& options) {
    if (options.record.video) { report::check_video(*options.record.video); }
    HeadlessListener run(options);
    const flight::FlightResult end = run.fly();
    for (const std::string& note : end.notes) { base::print_note(options.quiet, note); }
    for (const std::string& missing_programs : end.missing_programs) { base::print_note(false, missing_programs); }
    for (const sim::links::PacketReport& form : run.traffic().packet_reports()) {
        if (form.is_wrong) {
            base::print_note(options.quiet,
                fmt::format("note: {} packets from {}: {}", form.packets, sim::links::text_of(form.source), form.text));
        }
    }
    if (const long untold = run.traffic().counts().untold; untold > 0) {
        base::print_note(options.quiet, fmt::format("note: {} packets more, of too many kinds to tell each", untold));
    }
    print_summary(end, std::nullopt, options.json, results_of_run(run.traffic()));
    if (!end.fault.empty()) { throw Error(end.fault); }
}

} // namespace octant::ui::commands
