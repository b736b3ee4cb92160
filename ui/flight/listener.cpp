#include "ui/flight/listener.h"

#include "ui/flight/live_air.h"

#include <utility>

namespace octant::ui::flight {

using Taken = sim::links::LiveTraffic::Taken;

Listener::Listener(const ListenerOptions& options)
    : options_(options)
    , input_(options.input) {}

void Listener::attach(Session& session) {
    live_ = std::make_unique<LiveFlight>(options_.live, session.world());
    session.follow(*live_);
}

void Listener::record_into(const std::filesystem::path& folder) {
    writer_.emplace(folder, options_.live);
}

std::vector<std::string> Listener::take_news() {
    constexpr double every_s = 10.0;
    std::vector<std::string> news = live_->take_news();
    const double now_s = input_.now_s();
    if (!told_at_s_) {
        const std::vector<std::string> waits = input_.lines();
        news.insert(news.begin(), waits.begin(), waits.end());
        told_at_s_ = now_s - every_s + 1.0;
    } else if (now_s - *told_at_s_ >= every_s && !live_->traffic().vehicles().empty()) {
        const std::vector<std::string> stands = lines();
        news.insert(news.end(), stands.begin(), stands.end());
        told_at_s_ = now_s;
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
bool Listener::is_sent_again(const sim::links::Datagram& packet) {
    if (packet.protocol != sim::links::Protocol::Cigi) {
        return false;
    }
    const bool again = packet.source == last_message_.source && packet.bytes == last_message_.bytes;
    last_message_ = packet;
    answer_again_ = answer_again_ || again;
    return again;
}

/// Returns whether something moved; in steps nothing is taken after that.
bool Listener::take_waiting() {
    bool moved = false;
    while (!waiting_.empty() && !(options_.live.step && moved)) {
        const sim::links::Datagram packet = std::move(waiting_.front());
        waiting_.pop_front();
        if (options_.live.step && is_sent_again(packet)) {
            continue;
        }
        const Taken taken = live_->take(packet);
        if (writer_ && taken != Taken::Wrong) {
            writer_->add(packet);
        }
        moved = moved || taken == Taken::Moved;
    }
    return moved;
}

std::optional<double> Listener::take(Session& session) {
    constexpr std::size_t max_waiting = 20000; // in steps: more wait in the network
    if (waiting_.size() < max_waiting) {
        for (sim::links::Datagram& packet : input_.drain()) {
            waiting_.push_back(std::move(packet));
        }
    }
    const bool moved = take_waiting();
    if (options_.live.step && !moved) {
        return std::nullopt;
    }
    follow_visibility(*live_, session);
    const std::optional<std::string> time_of_day = follow_sun(*live_, session);
    if (writer_ && time_of_day) {
        writer_->add_time_of_day(*time_of_day);
    }
    const double time_s =
        options_.live.step ? static_cast<double>(++pictures_) / session.rate_hz() : input_.now_s();
    if (time_s >= words_at_s_) {
        constexpr double words_every_s = 0.5;
        const std::vector<std::string> words =
            options_.live.step ? std::vector<std::string>() : lines();
        session.pictures().set_words(words);
        if (writer_) {
            writer_->add_words(words);
        }
        words_at_s_ = time_s + words_every_s;
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

void Listener::call_hosts() {
    constexpr double every_s = 0.1;
    const double now_s = input_.now_s();
    const bool calls = !live_->traffic().cigi().has_host() && now_s >= called_at_s_;
    if (input_.has_cigi() && (calls || std::exchange(answer_again_, false))) {
        input_.send_cigi(live_->cigi_message(cigi_frames_, now_s));
        called_at_s_ = now_s + every_s;
    }
}

void Listener::finish() {
    if (writer_) {
        writer_->finish();
        writer_.reset();
    }
}

} // namespace octant::ui::flight
