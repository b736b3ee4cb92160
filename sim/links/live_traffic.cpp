#include "sim/links/live_traffic.h"

#include "sim/links/flightgear_fdm.h"

#include <algorithm>
#include <fmt/format.h>

namespace octant::sim::links {

namespace {

/// What was wrong is said as long as this.
constexpr double wrong_said_s = 5.0;

std::string motion_text(const LiveVehicle& vehicle, bool is_shown) {
    const double period_s = vehicle.clock().period_s();
    return fmt::format(
        "{} {}: {:.1f}/s, {} lost, {} late, jitter {:.0f} ms{}{}",
        text_of(vehicle.key().source),
        vehicle.key().vehicle,
        period_s > 0.0 ? 1.0 / period_s : 0.0,
        vehicle.clock().lost(),
        vehicle.late(),
        1000.0 * vehicle.clock().jitter_s(),
        is_shown && vehicle.is_stale() ? ", stale" : "",
        is_shown ? "" : ", not shown: no --aircraft left for it");
}

} // namespace

LiveVehicle* LiveTraffic::vehicle_of(const VehicleKey& key, double arrival_s) {
    const auto known = std::ranges::find(vehicles_, key, &LiveVehicle::key);
    if (known != vehicles_.end()) {
        return &*known;
    }
    const auto gone = std::ranges::find_if(vehicles_, [&](const LiveVehicle& vehicle) {
        return arrival_s - vehicle.last_arrival_s() > gone_after_s;
    });
    if (gone != vehicles_.end()) {
        *gone = LiveVehicle(key);
        return &*gone;
    }
    if (vehicles_.size() == most_vehicles) {
        return nullptr;
    }
    return &vehicles_.emplace_back(key);
}

bool LiveTraffic::move(const VehicleKey& key, const Fix& fix, double arrival_s) {
    LiveVehicle* const vehicle = vehicle_of(key, arrival_s);
    if (vehicle == nullptr) {
        ++counts_.unused;
        return false;
    }
    const long lost = vehicle->clock().lost();
    const bool taken = vehicle->add(fix, world_from_fix_(key, fix), arrival_s);
    counts_.lost += vehicle->clock().lost() - lost;
    counts_.late += taken ? 0 : 1;
    counts_.accepted += taken ? 1 : 0;
    newest_s_ = taken ? arrival_s : newest_s_;
    return taken;
}

void LiveTraffic::count(const Datagram& datagram, const Verdict& verdict) {
    Said& said = verdict.fault == Fault::None ? fine_ : wrong_;
    said = {datagram.source, verdict, datagram.arrival_s};
    counts_.wrong += verdict.fault == Fault::None ? 0 : 1;
}

bool LiveTraffic::take_fdm(const Datagram& datagram) {
    Fix fix;
    const Verdict verdict = decode_fdm(datagram.bytes, fix);
    count(datagram, verdict);
    return verdict.fault == Fault::None &&
           move({datagram.protocol, datagram.source, 0}, fix, datagram.arrival_s);
}

bool LiveTraffic::take(const Datagram& datagram) {
    switch (datagram.protocol) {
    case Protocol::Fdm:
        return take_fdm(datagram);
    default:
        ++counts_.unused;
        return false;
    }
}

std::size_t LiveTraffic::show(double now_s, double delay_s, std::span<AircraftState> states) {
    const double passed_s = shown_once_ ? now_s - shown_s_ : 0.0;
    shown_ = std::min(states.size(), vehicles_.size());
    counts_.snaps = 0;
    for (std::size_t i = 0; i < shown_; ++i) {
        states[i] = vehicles_[i].show(now_s, delay_s, passed_s);
        counts_.snaps += vehicles_[i].snaps();
    }
    shown_s_ = now_s;
    shown_once_ = true;
    return shown_;
}

bool LiveTraffic::is_stale() const {
    return std::any_of(
        vehicles_.begin(),
        vehicles_.begin() + static_cast<std::ptrdiff_t>(shown_),
        [](const LiveVehicle& vehicle) { return vehicle.is_stale(); });
}

std::vector<std::string> LiveTraffic::lines() const {
    std::vector<std::string> lines;
    if (fine_.at_s >= 0.0) {
        lines.push_back(fmt::format("{}: {}", text_of(fine_.source), fdm_text(fine_.verdict)));
    }
    constexpr std::size_t most_lines = 4;
    for (std::size_t i = 0; i < std::min(vehicles_.size(), most_lines); ++i) {
        lines.push_back(motion_text(vehicles_[i], i < shown_ || shown_ == 0));
    }
    if (vehicles_.size() > most_lines) {
        lines.push_back(fmt::format("and {} vehicles more", vehicles_.size() - most_lines));
    }
    if (wrong_.at_s >= 0.0 && shown_s_ - wrong_.at_s < wrong_said_s) {
        lines.push_back(fmt::format(
            "{}: {}; {} wrong packets so far",
            text_of(wrong_.source),
            fdm_text(wrong_.verdict),
            counts_.wrong));
    }
    return lines;
}

} // namespace octant::sim::links
