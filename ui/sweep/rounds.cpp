#include "ui/sweep/rounds.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "ui/base/progress.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_file.h"
#include "ui/sweep/turns.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace octant::ui::sweep {

namespace {

namespace fs = std::filesystem;

constexpr std::array side_names{"old", "new"};
constexpr int min_rounds = 3; // for an interval

bool is_bound_to_clock(const settings::RunSettings& settings) {
    return settings.adapt.terrain || settings.adapt.shading || settings.time.realtime;
}

/// Command lines of both programs, for recordings "old-END" and "new-END".
std::array<TurnFlight, 2> command_lines(const std::array<ComparedProgram, 2>& programs, const fs::path& folder,
    const std::string& end, const std::vector<std::string>& more_words) {
    std::array<TurnFlight, 2> flights;
    for (std::size_t s = 0; s < flights.size(); ++s) {
        const std::string side = side_names[s];
        const fs::path recording = folder / fmt::format("{}-{}", side, end);
        flights[s] = {programs[s].name,
            {programs[s].program.string(), "fly", "--settings", (folder / (side + ".json")).string(), "--record",
                recording.string(), "--quiet"},
            recording, folder / (side + ".log")};
        flights[s].words.insert(flights[s].words.end(), more_words.begin(), more_words.end());
    }
    return flights;
}

double median_frame_ms(const report::FrameTimes& times) { return report::median_of(times.frame_ms); }

/// Standard deviation of the logarithm of the median frame time.
double drift_of(std::span<const report::FrameTimes> flights) {
    if (flights.size() < 2) { return 0.0; }
    std::vector<double> logarithms;
    for (const report::FrameTimes& each : flights) { logarithms.push_back(std::log(median_frame_ms(each))); }
    const auto count = static_cast<double>(logarithms.size());
    const double mean = std::accumulate(logarithms.begin(), logarithms.end(), 0.0) / count;
    double squares = 0.0;
    for (const double each : logarithms) { squares += (each - mean) * (each - mean); }
    return std::sqrt(squares / (count - 1.0));
}

/// "interval -0.4 to +1.2 %"; empty where there is none.
std::string interval_text(const report::FrameChange& change) {
    return change.change
               ? fmt::format("interval {:+.1f} to {:+.1f} %", 100.0 * change.low_share(), 100.0 * change.high_share())
               : std::string();
}

/// The rounds of one flight.
class Rounds {
public:
    Rounds(const std::array<ComparedProgram, 2>& programs, const RoundFlight& flight, fs::path folder,
        RandomGenerator& dice)
        : programs_(programs), folder_(std::move(folder)), dice_(dice),
          in_turns_(std::ranges::none_of(flight.settings, is_bound_to_clock)) {
        make_folder(folder_);
        for (std::size_t s = 0; s < side_names.size(); ++s) {
            write_file(folder_ / fmt::format("{}.json", side_names[s]), changed_settings_json(flight.settings[s]));
        }
    }

    /// Flies one more round.
    void fly_one() {
        ++count_;
        const std::vector<std::string> no_pictures = {"--pictures", "0"};
        const auto lines = command_lines(
            programs_, folder_, fmt::format("r{}", count_), count_ == 1 ? std::vector<std::string>() : no_pictures);
        const Stopwatch round;
        const auto turn_s = in_turns_ ? std::optional(turn_s_) : std::nullopt;
        const std::array<double, 2> ran_s = fly_in_turns(lines, turn_s, dice_);
        for (std::size_t s = 0; s < lines.size(); ++s) {
            recordings_.push_back(report::load_recording(lines[s].recording));
            const report::LoadedRecording& recording = recordings_.back();
            times_[s].push_back(report::read_frame_times(recording));
            if (recording.ended_early || !recording.run.stopped.empty() || times_[s].back().frame_ms.empty()) {
                throw Error(fmt::format(
                    "{}: expected a whole flight with frames after its warm-up, got {} frames after it (see {})",
                    programs_[s].name, times_[s].back().frame_ms.size(), lines[s].log.string()));
            }
            constexpr double frames_in_turn = 8.0;
            const auto frames = static_cast<double>(recording.flight.frames());
            turn_s_ = std::max(turn_s_, count_ == 1 ? frames_in_turn * ran_s[s] / frames : 0.0);
        }
        round_s_ = round.s();
        const report::LoadedRecording& first = recordings_.front();
        for (std::size_t i = recordings_.size() - 2; i < recordings_.size(); ++i) {
            same_frames_ = same_frames_ && first.run.state_hash == recordings_[i].run.state_hash &&
                           report::flight_differences(first, recordings_[i], &settings::comparison_role).empty();
        }
    }

    report::FrameChange frame_change() const { return report::frame_change(times_[0], times_[1], {}, same_frames_); }

    /// How long a round takes: the last one.
    double round_s() const { return round_s_; }

    int count() const { return count_; }

    FlownRounds results(const std::string& flight, double seconds) {
        FlownRounds flown;
        std::array<report::Variant, 2> variants;
        for (std::size_t i = 0; i < recordings_.size(); ++i) { variants[i % 2].runs.push_back(i); }
        for (std::size_t s = 0; s < variants.size(); ++s) { variants[s].name = programs_[s].name; }
        flown.change = report::flight_change(recordings_, variants[0], variants[1], &settings::comparison_role);
        flown.change.flight = flight;
        flown.change.frames = frame_change();
        flown.recordings = std::move(recordings_);
        flown.turn_s = in_turns_ ? std::optional(turn_s_) : std::nullopt;
        flown.seconds = seconds;
        flown.drift = drift_of(times_[0]);
        return flown;
    }

private:
    const std::array<ComparedProgram, 2>& programs_;
    fs::path folder_;
    RandomGenerator& dice_;
    bool in_turns_;
    bool same_frames_ = true;
    int count_ = 0;
    double turn_s_ = min_turn_s;
    double round_s_ = 0.0;
    std::vector<report::LoadedRecording> recordings_;
    std::array<std::vector<report::FrameTimes>, 2> times_;
};

} // namespace

FlownRounds fly_rounds(const std::array<ComparedProgram, 2>& programs, const RoundFlight& flight,
    const fs::path& folder, const RoundLimits& limits, RandomGenerator& dice, bool quiet) {
    const Stopwatch flying;
    Rounds rounds(programs, flight, folder, dice);
    rounds.fly_one();
    const int expected = limits.rounds.value_or(
        std::max(min_rounds, static_cast<int>(std::min(1e6, limits.max_seconds / rounds.round_s()))));
    base::Progress progress(flight.name, expected, quiet, "rounds");
    int next_look = 6;
    std::string interval;
    const auto is_enough = [&] {
        if (limits.rounds) { return rounds.count() >= *limits.rounds; }
        if (rounds.count() < min_rounds) { return false; }
        if (flying.s() + rounds.round_s() > limits.max_seconds) { return true; }
        if (rounds.count() < next_look) { return false; }
        constexpr double growth = 1.45;
        next_look = static_cast<int>(std::lround(growth * next_look));
        const report::FrameChange change = rounds.frame_change();
        interval = interval_text(change);
        return change.change && change.high_share() - change.low_share() <= limits.within;
    };
    while (!is_enough()) {
        progress.show(std::min(rounds.count(), expected), interval);
        rounds.fly_one();
    }
    progress.finish();
    return rounds.results(flight.name, flying.s());
}

std::array<fs::path, 2> fly_to_frame(
    const std::array<ComparedProgram, 2>& programs, const fs::path& folder, int frame, RandomGenerator& dice) {
    // Every Nth picture is written: frame 0 and this one.
    const auto lines = command_lines(programs, folder, fmt::format("frame-{}", frame),
        {"--frames", fmt::format("{}", frame + 1), "--pictures", fmt::format("{}", std::max(1, frame))});
    fly_in_turns(lines, std::nullopt, dice);
    const std::string picture = fmt::format("picture-{:05}.png", frame);
    return {lines[0].recording / picture, lines[1].recording / picture};
}

std::string changed_settings_json(const settings::RunSettings& settings) {
    const nlohmann::ordered_json defaults = settings::settings_json(settings::RunSettings());
    const nlohmann::ordered_json all = settings::settings_json(settings);
    nlohmann::ordered_json changed = nlohmann::ordered_json::object();
    for (const auto& [name, value] : all.items()) {
        if (defaults[name] != value) { changed[name] = value; }
    }
    return changed.dump(2) + "\n";
}

} // namespace octant::ui::sweep
