#pragma once

#include "ui/flight/flight_recorder.h"
#include "ui/flight/live_flight.h"
#include "ui/flight/quality_controller.h"
#include "ui/flight/session.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::flight {

/// A recording to repeat frame by frame: targets and hashes read from it.
struct Replay {
    std::filesystem::path folder;
    /// By frame, at least one.
    std::vector<QualityTargets> quality_targets;
    /// False where it was killed and has no hashes.
    bool ended = false;
    /// Sixteen hex digits.
    std::string state_hash;
    std::string picture_hash;
};

/// Reads run.json and frames.csv of a recording, a killed one too; its settings are for read_settings(). Throws Error
/// with file and line for rows that are damaged, missing among others or without a triangle target.
Replay read_replay(const std::filesystem::path& folder);

/// Throws Error when the recording has more rows than its settings make frames.
void check_frames(const Replay& replay, int frames);

/// How a replay compares with its recording.
struct ReplayComparison {
    /// "same", "other" or "unknown" (the recording was killed).
    std::string state_hash;
    /// "same", "other" or "unknown", as state_hash.
    std::string picture_hash;
    /// Whether both hashes are known to be the same.
    bool is_same = false;
    /// All of it for people.
    std::string line;
};

ReplayComparison compare_with_recording(const Replay& replay, std::uint64_t state_hash, std::uint64_t picture_hash);

/// A live flight that was flown again.
struct PacketReplay {
    /// Must outlive the session's last use.
    std::unique_ptr<LiveFlight> live;
    /// What ended it before its last picture, empty = nothing did.
    std::string stopped;
};

/// Flies a recorded live flight again in a session of its settings: the same packets for the same pictures, until a
/// stop signal comes. Throws Error.
PacketReplay replay_packets(const Replay& replay, Session& session, FlightRecorder& recorder, bool quiet);

} // namespace octant::ui::flight
