#include "ui/flight/listener.h"

#include "ui/flight/live_environment.h"

#include <utility>

namespace octant::ui::flight {

using PacketOutcome = sim::links::LiveTraffic::PacketOutcome;

Listener::Listener(const ListenerOptions& options)
    : options_(options)
    , input_(options.input) {}

void Listener::attach(Session& session) {
    live_ = std::make_unique<LiveFlight>(options_.live, session.world());
    session.set_state_source(*live_);
}

void Listener::start_packet_recording(const std::filesystem::path& folder) {
    writer_.emplace(folder, options_.live);
}

std::vector<std::string> Listener::take_new_messages() {
    constexpr double every_s = 10.0;
    std::vector<std::string> news = live_->take_new_messages();
    const double now_s = input_.now_s();
    if (!reported_at_s_) {
        const std::vector<std::string> waits = input_.lines();
        news.insert(news.begin(), waits.begin(), waits.end());
        reported_at_s_ = now_s - every_s + 1.0;
    } else if (now_s - *reported_at_s_ >= every_s && !live_->traffic().vehicles().empty()) {
        const std::vector<std::string> stands = lines();
        news.insert(news.end(), stands.begin(), stands.end());
        reported_at_s_ = now_s;
    }
    return news;
}

std::vector<std::string> Listener::lines() const {
    std::vector<std::string> lines = live_->lines();
    if (live_->traffic().vehicles().empty()) {
        const std::vector<std::string> waits = input_.lines();
        lines.insert(lines.begin(), waits.begin(), waits.end());
    }
    return lines;
}

/// Whether it is a host's last message once more, as hosts send it that have not heard of its
/// picture. It is to be answered, not shown again.
bool Listener::is_retransmission(const sim::links::Datagram& packet) {
    if (packet.protocol != sim::links::Protocol::Cigi) {
        return false;
    }
    const bool repeat_option = packet.source == last_message_.source && packet.bytes == last_message_.bytes;
    last_message_ = packet;
    answers_retransmission_ = answers_retransmission_ || repeat_option;
    return repeat_option;
}

/// Returns whether something moved; in steps nothing is taken after that.
bool Listener::take_pending() {
    bool moved = false;
    while (!pending_.empty() && !(options_.live.step && moved)) {
        const sim::links::Datagram packet = std::move(pending_.front());
        pending_.pop_front();
        if (options_.live.step && is_retransmission(packet)) {
            continue;
        }
        const PacketOutcome taken = live_->take(packet);
        if (writer_ && taken != PacketOutcome::Wrong) {
            writer_->add(packet);
        }
        moved = moved || taken == PacketOutcome::Moved;
    }
    return moved;
}

std::optional<double> Listener::take(Session& session) {
    constexpr std::size_t max_waiting = 20000; // in steps: more wait in the network
    if (pending_.size() < max_waiting) {
        for (sim::links::Datagram& packet : input_.drain()) {
            pending_.push_back(std::move(packet));
        }
    }
    const bool moved = take_pending();
    if (options_.live.step && !moved) {
        return std::nullopt;
    }
    apply_host_visibility(*live_, session);
    const std::optional<std::string> time_of_day = apply_host_time_of_day(*live_, session);
    if (writer_ && time_of_day) {
        writer_->add_time_of_day(*time_of_day);
    }
    const double time_s =
        options_.live.step ? static_cast<double>(++pictures_) / session.rate_hz() : input_.now_s();
    if (time_s >= overlay_at_s_) {
        constexpr double words_every_s = 0.5;
        const std::vector<std::string> overlay_lines =
            options_.live.step ? std::vector<std::string>() : lines();
        session.pictures().set_overlay_lines(overlay_lines);
        if (writer_) {
            writer_->add_overlay_lines(overlay_lines);
        }
        overlay_at_s_ = time_s + words_every_s;
    }
    if (writer_) {
        writer_->add_picture(time_s);
    }
    return time_s;
}

void Listener::finish_picture(report::FrameRecord& record) {
    live_->fill_in(record, input_.now_s());
    if (input_.has_cigi()) {
        input_.send_cigi(live_->cigi_message(++cigi_frames_, input_.now_s()));
    }
}

void Listener::contact_hosts() {
    constexpr double every_s = 0.1;
    const double now_s = input_.now_s();
    const bool calls = !live_->traffic().cigi().has_host() && now_s >= hosts_contacted_at_s_;
    if (input_.has_cigi() && (calls || std::exchange(answers_retransmission_, false))) {
        input_.send_cigi(live_->cigi_message(cigi_frames_, now_s));
        hosts_contacted_at_s_ = now_s + every_s;
    }
}

void Listener::finish() {
    if (writer_) {
        writer_->finish();
        writer_.reset();
    }
}

} // namespace octant::ui::flight
