#include "sim/links/live_traffic.h"

#include "sim/hidden_height.h"
#include "sim/links/dis_entity.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/packet_kind.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace octant::sim::links {

namespace {

/// What was wrong is said as long as this.
constexpr double wrong_said_s = 5.0;

std::string motion_text(
    const LiveVehicle& vehicle,
    const std::string& name,
    const std::optional<long>& lost,
    bool is_shown) {
    const double period_s = vehicle.clock().period_s();
    return fmt::format(
        "{} {}: {:.1f}/s, {}, {} late, jitter {:.0f} ms{}{}",
        text_of(vehicle.key().source),
        name,
        period_s > 0.0 ? 1.0 / period_s : 0.0,
        lost ? fmt::format("{} lost", *lost) : "losses unknown",
        vehicle.late(),
        1000.0 * vehicle.clock().jitter_s(),
        is_shown && vehicle.is_stale() ? ", stale" : "",
        is_shown ? "" : ", not shown: no --aircraft left for it");
}

constexpr std::size_t max_streams = 64;

/// What is kept of a stream, which is new where there is room for it: of the full table those make
/// room that were silent the longest, and for so long. Null where none was.
template <class Streams>
typename Streams::mapped_type* stream_of(
    Streams& streams, const typename Streams::key_type& key, double arrival_s, double gone_s) {
    auto known = streams.find(key);
    if (known == streams.end()) {
        if (streams.size() >= max_streams) {
            const auto silent = std::ranges::min_element(
                streams, {}, [](const auto& stream) { return stream.second.last_s; });
            if (arrival_s - silent->second.last_s < gone_s) {
                return nullptr;
            }
            streams.erase(silent);
        }
        known = streams.try_emplace(key).first;
    }
    known->second.last_s = arrival_s;
    return &known->second;
}

std::string verdict_text(Protocol protocol, const DecodeResult& verdict) {
    if (verdict.fault == PacketError::OtherKind) {
        return std::string(text_of(PacketKind{verdict.got}));
    }
    switch (protocol) {
    case Protocol::Lines:
        return NamedColumns::text_of(verdict);
    case Protocol::XPlane:
        return xplane_text(verdict);
    case Protocol::MavLink:
        return mavlink_text(verdict);
    case Protocol::Dis:
        return dis_text(verdict);
    case Protocol::Cigi:
        return cigi_text(verdict);
    default:
        return fdm_text(verdict);
    }
}

/// The verdict on a packet that its port's decoder does not use: what it is in truth, where its
/// form tells that. To a decoder of DIS, a message of CIGI 3 is a PDU of another type.
DecodeResult identified(const Datagram& datagram, const DecodeResult& verdict) {
    const auto kind = verdict.fault != PacketError::None && datagram.protocol != Protocol::Lines
                          ? packet_kind(datagram.bytes)
                          : std::nullopt;
    if (!kind || protocol_of(*kind) == datagram.protocol) {
        return verdict;
    }
    return {PacketError::OtherKind, static_cast<std::uint32_t>(*kind), 0};
}

} // namespace

std::string name_of(const VehicleKey& key) {
    switch (key.protocol) {
    case Protocol::Dis:
        return fmt::format(
            "{}:{}:{}", key.vehicle >> 32U, key.vehicle >> 16U & 0xffffU, key.vehicle & 0xffffU);
    case Protocol::MavLink:
        return fmt::format("system {}", key.vehicle);
    case Protocol::Cigi:
        return fmt::format("entity {}", key.vehicle);
    case Protocol::Lines:
        return fmt::format("id {}", key.vehicle);
    default:
        return "aircraft";
    }
}

LiveVehicle* LiveTraffic::vehicle_of(const VehicleKey& key, double arrival_s) {
    if (const auto known = numbers_.find(key); known != numbers_.end()) {
        return &vehicles_[known->second];
    }
    const auto silent_for = [arrival_s](double min_s) {
        return [arrival_s, min_s](const LiveVehicle& vehicle) {
            return arrival_s - vehicle.last_arrival_s() > min_s;
        };
    };
    const auto is_restarted = [&](const LiveVehicle& vehicle) {
        const VehicleKey& old = vehicle.key();
        return old.protocol == key.protocol && old.source.address == key.source.address &&
               old.vehicle == key.vehicle && silent_for(restarted_after_s)(vehicle);
    };
    auto gone = std::ranges::find_if(vehicles_, is_restarted);
    if (gone == vehicles_.end()) {
        gone = std::ranges::find_if(vehicles_, silent_for(gone_after_s));
    }
    if (gone != vehicles_.end()) {
        numbers_.erase(gone->key());
        numbers_.emplace(key, static_cast<std::size_t>(gone - vehicles_.begin()));
        *gone = LiveVehicle(key);
        return &*gone;
    }
    if (vehicles_.size() == max_vehicles) {
        return nullptr;
    }
    numbers_.emplace(key, vehicles_.size());
    return &vehicles_.emplace_back(key);
}

/// Notes what came of a vehicle.
void LiveTraffic::report(const VehicleKey& key, const Fix& fix, const std::string& marking) {
    auto known = reports_.find(key);
    if (known == reports_.end()) {
        if (reports_.size() >= max_reported) {
            return;
        }
        known = reports_.try_emplace(key).first;
    }
    VehicleReport& told = known->second;
    ++told.packets;
    told.latitude_deg = fix.latitude_deg;
    told.longitude_deg = fix.longitude_deg;
    told.altitude_m = fix.altitude_m;
    if (told.marking != marking) {
        told.marking = marking;
    }
}

LiveTraffic::PacketOutcome
LiveTraffic::move(const Datagram& datagram, const Fix& fix, const std::string& marking) {
    const VehicleKey key{datagram.protocol, datagram.source, fix.vehicle};
    report(key, fix, marking);
    LiveVehicle* const vehicle = vehicle_of(key, datagram.arrival_s);
    if (vehicle == nullptr) {
        ++counts_.unused;
        return PacketOutcome::Right;
    }
    const WorldPosition place = world_from_fix_(key, fix);
    const bool taken =
        vehicle->add(with_rotated_axes(fix, place.north_bearing_rad), place.at_m, datagram.arrival_s);
    if (!taken) {
        ++counts_.late;
        return PacketOutcome::Right;
    }
    ++counts_.accepted;
    newest_s_ = datagram.arrival_s;
    return PacketOutcome::Moved;
}

/// Counts and remembers what is to be said of a packet. Never Moved.
LiveTraffic::PacketOutcome LiveTraffic::count(const Datagram& datagram, const DecodeResult& decoded) {
    const DecodeResult verdict = identified(datagram, decoded);
    const bool wrong = verdict.fault != PacketError::None && verdict.fault != PacketError::Unused;
    if (verdict.fault == PacketError::Unused) {
        ++counts_.unused;
    } else {
        (wrong ? last_rejected_
               : last_accepted_) = {datagram.protocol, datagram.source, verdict, datagram.arrival_s};
    }
    counts_.wrong += wrong ? 1 : 0;
    tally(datagram, verdict);
    return wrong ? PacketOutcome::Wrong : PacketOutcome::Right;
}

/// Counts a packet by its kind. A new kind is told where there is room for it.
void LiveTraffic::tally(const Datagram& datagram, const DecodeResult& verdict) {
    constexpr std::size_t max_first = 200; // kinds of a fault that are the first of their sender
    constexpr std::size_t max_in_all = 100;
    constexpr std::ptrdiff_t max_of_sender = 16;
    const bool got_is_size = verdict.fault == PacketError::WrongSize || verdict.fault == PacketError::NotOurs;
    const PacketErrorKey form{
        verdict.fault, datagram.source, datagram.protocol, got_is_size ? 0U : verdict.got};
    const auto known = packet_tallies_.find(form);
    if (known != packet_tallies_.end()) {
        ++known->second.packets;
        known->second.is_uniform = known->second.is_uniform && known->second.first == verdict;
        return;
    }
    constexpr Protocol first_protocol{};
    const auto begin = packet_tallies_.lower_bound({verdict.fault, datagram.source, first_protocol, 0});
    const auto end = std::find_if(begin, packet_tallies_.end(), [&](const auto& heard) {
        return heard.first.fault != verdict.fault || heard.first.source != datagram.source;
    });
    const auto of_sender = std::distance(begin, end);
    std::size_t& forms = error_keys_[verdict.fault];
    if (forms >= (of_sender == 0 ? max_first : max_in_all) || of_sender >= max_of_sender) {
        ++counts_.untold;
        return;
    }
    ++forms;
    packet_tallies_.emplace(form, PacketTally{verdict, 1});
    messages_.push_back(
        fmt::format("{}: {}", text_of(datagram.source), verdict_text(datagram.protocol, verdict)));
}

/// Takes the number that a packet bears in a stream of its sender.
void LiveTraffic::number(
    const Datagram& datagram, std::uint16_t stream, std::uint32_t number, int bits) {
    auto* const known = stream_of(
        sequences_, {datagram.protocol, datagram.source, stream}, datagram.arrival_s, gone_after_s);
    if (known == nullptr) {
        return;
    }
    SequenceCount& sequence = known->value;
    const long before = sequence.lost();
    sequence.add(number, bits, datagram.arrival_s);
    if (sequence.is_numbered()) {
        counts_.lost = counts_.lost.value_or(0);
    }
    if (counts_.lost) {
        *counts_.lost += sequence.lost() - before;
    }
}

/// What a vehicle's sender lost of the streams that it numbers; nothing where it numbers none.
std::optional<long> LiveTraffic::lost_of(const VehicleKey& key) const {
    std::optional<long> lost;
    for (const auto& [stream, sequence] : sequences_) {
        const auto& [protocol, source, number] = stream;
        const bool is_its_own = key.protocol != Protocol::MavLink || number >> 8U == key.vehicle;
        if (protocol == key.protocol && source == key.source && is_its_own &&
            sequence.value.is_numbered()) {
            lost = lost.value_or(0) + sequence.value.lost();
        }
    }
    return lost;
}

LiveTraffic::PacketOutcome LiveTraffic::take_fdm(const Datagram& datagram) {
    Fix fix;
    const DecodeResult verdict = decode_fdm(datagram.bytes, fix);
    const PacketOutcome counted = count(datagram, verdict);
    return verdict.fault == PacketError::None ? move(datagram, fix) : counted;
}

LiveTraffic::PacketOutcome LiveTraffic::take_line(const Datagram& datagram) {
    // No more clients than that are connected at a time: who is silent longest has gone.
    auto* const stream = stream_of(columns_, datagram.source, datagram.arrival_s, 0.0);
    if (stream == nullptr) {
        ++counts_.unused;
        return PacketOutcome::Wrong;
    }
    Fix fix;
    const DecodeResult verdict = stream->value.take(datagram.bytes, fix);
    DecodeResult said = verdict;
    said.size = 0; // Lines differ in length and are told once.
    const PacketOutcome counted = count(datagram, said);
    return verdict.fault == PacketError::None ? move(datagram, fix) : counted;
}

LiveTraffic::PacketOutcome LiveTraffic::take_mavlink(const Datagram& datagram) {
    PacketOutcome taken = PacketOutcome::Wrong;
    for (Bytes rest = datagram.bytes; !rest.empty();) {
        const MavLinkParse parse = parse_mavlink(rest);
        DecodeResult said = parse.verdict;
        said.size = said.fault == PacketError::NotOurs ? said.size : 0;
        taken = std::max(taken, count(datagram, said));
        if (identified(datagram, said).fault == PacketError::OtherKind) {
            break;
        }
        if (said.fault == PacketError::None || said.fault == PacketError::Unused) {
            const unsigned component = unsigned{parse.system} << 8U | parse.component;
            number(datagram, static_cast<std::uint16_t>(component), parse.sequence, 8);
        }
        auto* const stream = parse.frame ? stream_of(
                                               poses_,
                                               {datagram.source, parse.frame->system},
                                               datagram.arrival_s,
                                               gone_after_s)
                                         : nullptr;
        if (stream != nullptr) {
            if (const auto fix = stream->value.take(*parse.frame, ellipsoid_)) {
                taken = std::max(taken, move(datagram, *fix));
            }
        }
        rest = rest.subspan(parse.length);
    }
    return taken;
}

LiveTraffic::PacketOutcome LiveTraffic::take_dis(const Datagram& datagram) {
    if (!ellipsoid_.is_earth() && !std::exchange(has_reported_dis_, true)) {
        messages_.push_back(fmt::format(
            "DIS: places count from the centre of the earth (WGS 84), as its standard has it; on "
            "{} their latitudes, longitudes and heights count",
            name_of_body(ellipsoid_)));
    }
    DisEntity entity;
    const DecodeResult verdict = decode_dis(datagram.bytes, entity);
    const PacketOutcome counted = count(datagram, verdict);
    return verdict.fault == PacketError::None ? move(datagram, entity.fix, marking_of(entity)) : counted;
}

LiveTraffic::PacketOutcome LiveTraffic::take_xplane(const Datagram& datagram) {
    std::optional<Fix> fix;
    if (packet_kind(datagram.bytes) != PacketKind::XPlane) {
        return count(datagram, XPlanePose().take(datagram.bytes, fix)); // takes no stream
    }
    auto* const stream = stream_of(xplanes_, datagram.source, datagram.arrival_s, gone_after_s);
    if (stream == nullptr) {
        ++counts_.unused;
        return PacketOutcome::Wrong;
    }
    const PacketOutcome counted = count(datagram, stream->value.take(datagram.bytes, fix));
    return fix ? move(datagram, *fix) : counted;
}

LiveTraffic::PacketOutcome LiveTraffic::take_cigi(const Datagram& datagram) {
    std::vector<Fix> moved;
    DecodeResult verdict = cigi_.take(datagram.bytes, moved, datagram.arrival_s);
    if (verdict.fault == PacketError::None) {
        verdict.size = 0; // Messages differ in length and are told once.
    }
    const PacketOutcome counted = count(datagram, verdict);
    if (verdict.fault != PacketError::None) {
        return counted;
    }
    number(datagram, 0, cigi_.host_frame(), 32);
    for (const Fix& fix : moved) {
        move(datagram, fix);
    }
    for (const std::uint16_t entity : cigi_.take_removed()) {
        const VehicleKey key{Protocol::Cigi, datagram.source, entity};
        if (const auto known = numbers_.find(key); known != numbers_.end()) {
            vehicles_[known->second].hide();
        }
    }
    return PacketOutcome::Moved; // A host's message is a frame, whatever moves in it.
}

LiveTraffic::PacketOutcome LiveTraffic::take(const Datagram& datagram) {
    switch (datagram.protocol) {
    case Protocol::Fdm:
        return take_fdm(datagram);
    case Protocol::Lines:
        return take_line(datagram);
    case Protocol::MavLink:
        return take_mavlink(datagram);
    case Protocol::Dis:
        return take_dis(datagram);
    case Protocol::Cigi:
        return take_cigi(datagram);
    case Protocol::XPlane:
        return take_xplane(datagram);
    default:
        ++counts_.unused;
        return PacketOutcome::Wrong;
    }
}

std::size_t LiveTraffic::show_newest(double now_s, std::span<AircraftState> states) {
    shown_ = std::min(states.size(), vehicles_.size());
    for (std::size_t i = 0; i < shown_; ++i) {
        states[i] = vehicles_[i].newest();
    }
    remove_hidden(states.first(shown_));
    shown_s_ = now_s;
    return shown_;
}

std::size_t LiveTraffic::show(double now_s, double delay_s, std::span<AircraftState> states) {
    const double passed_s = has_shown_ ? now_s - shown_s_ : 0.0;
    shown_ = std::min(states.size(), vehicles_.size());
    counts_.snaps = 0;
    for (std::size_t i = 0; i < shown_; ++i) {
        states[i] = vehicles_[i].show(now_s, delay_s, passed_s);
        counts_.snaps += vehicles_[i].snaps();
    }
    remove_hidden(states.first(shown_));
    shown_s_ = now_s;
    has_shown_ = true;
    return shown_;
}

void LiveTraffic::remove_hidden(std::span<AircraftState> states) const {
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (vehicles_[i].is_hidden()) {
            states[i].position_m.z = absent_height_m;
        }
    }
}

bool LiveTraffic::is_stale() const {
    return std::any_of(
        vehicles_.begin(),
        vehicles_.begin() + static_cast<std::ptrdiff_t>(shown_),
        [](const LiveVehicle& vehicle) { return vehicle.is_stale() && !vehicle.is_hidden(); });
}

std::vector<std::string> LiveTraffic::take_new_messages() {
    return std::exchange(messages_, {});
}

std::vector<std::string> LiveTraffic::lines() const {
    std::vector<std::string> lines;
    if (last_accepted_.at_s >= 0.0) {
        lines.push_back(fmt::format(
            "{}: {}", text_of(last_accepted_.source), verdict_text(last_accepted_.protocol, last_accepted_.verdict)));
    }
    constexpr std::size_t max_lines = 4;
    for (std::size_t i = 0; i < std::min(vehicles_.size(), max_lines); ++i) {
        const VehicleKey& key = vehicles_[i].key();
        const auto known = reports_.find(key);
        const std::string marking = known == reports_.end() ? "" : known->second.marking;
        lines.push_back(motion_text(
            vehicles_[i],
            marking.empty() ? name_of(key) : fmt::format("{} {}", name_of(key), marking),
            lost_of(key),
            i < shown_ || shown_ == 0));
    }
    if (vehicles_.size() > max_lines) {
        lines.push_back(fmt::format("and {} vehicles more", vehicles_.size() - max_lines));
    }
    if (last_rejected_.at_s >= 0.0 && shown_s_ - last_rejected_.at_s < wrong_said_s) {
        lines.push_back(fmt::format(
            "{}: {}; {} wrong packets so far",
            text_of(last_rejected_.source),
            verdict_text(last_rejected_.protocol, last_rejected_.verdict),
            counts_.wrong));
    }
    if (vehicles_.size() == max_vehicles) {
        lines.push_back(fmt::format(
            "{} vehicles in all, {} are followed, {} shown",
            reports_.size(),
            vehicles_.size(),
            shown_));
    }
    return lines;
}

std::vector<VehicleReport> LiveTraffic::vehicle_reports() const {
    std::vector<VehicleReport> all;
    all.reserve(reports_.size());
    for (const auto& [key, told] : reports_) {
        const auto known = numbers_.find(key);
        VehicleReport& report = all.emplace_back(told);
        report.name = name_of(key);
        report.protocol = key.protocol;
        report.source = key.source;
        report.is_shown = known != numbers_.end() && known->second < shown_;
    }
    return all;
}

std::vector<PacketReport> LiveTraffic::packet_reports() const {
    std::vector<PacketReport> all;
    for (const auto& [form, heard] : packet_tallies_) {
        all.push_back(
            {form.source,
             verdict_text(form.protocol, heard.first) +
                 (heard.is_uniform ? "" : " (the first of them)"),
             heard.packets,
             form.fault != PacketError::None && form.fault != PacketError::Unused});
    }
    return all;
}

} // namespace octant::sim::links
