#pragma once

#include "sim/base/random_generator.h"
#include "ui/report/comparison.h"
#include "ui/settings/settings.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::sweep {

/// One side of a comparison: a program and its name in messages and tables.
struct ComparedProgram {
    std::string name;
    std::filesystem::path program;
};

/// A flight that two programs fly, each by its settings. Old first, as in everything of a comparison.
struct RoundFlight {
    std::string name; ///< of its folder
    std::array<settings::RunSettings, 2> settings;
};

/// When enough rounds are flown.
struct RoundLimits {
    double within = 0.02;      ///< width of the interval of the change, as a share
    double max_seconds = 30.0; ///< for all rounds of a flight; three are flown in any case
    std::optional<int> rounds; ///< exactly so many, whatever the width and the time
};

/// What came of the rounds of a flight.
struct FlownRounds {
    std::vector<report::LoadedRecording> recordings; ///< old and new of the first round, then of the second, ...
    report::FlightChange change;
    std::optional<double> turn_s; ///< length of the last round's turns; nothing: each flight was flown whole
    double seconds = 0.0;
    double drift = 0.0; ///< standard deviation of the logarithm of the old side's median frame time over the rounds
};

/// Flies rounds of two flights, one by each program, in turns (fly_in_turns), or whole where their settings follow the
/// clock. Recordings and logs are written to `folder`: old.json, old.log, old-r1, ... and new. Only the first round's
/// have pictures. The rounds end with the limits: the width is looked at after 6, 9, 13, 19, ... rounds, so that
/// looking more often does not make chance differences into changes. Throws as fly_in_turns.
FlownRounds fly_rounds(const std::array<ComparedProgram, 2>& programs, const RoundFlight& flight,
    const std::filesystem::path& folder, const RoundLimits& limits, RandomGenerator& dice, bool quiet);

/// Flies both once more as far as a frame, of which old-frame-N and new-frame-N in `folder` then have the picture.
/// Returns both pictures. Throws as fly_in_turns.
std::array<std::filesystem::path, 2> fly_to_frame(const std::array<ComparedProgram, 2>& programs,
    const std::filesystem::path& folder, int frame, RandomGenerator& dice);

/// The settings that are not the defaults, as a settings file: readable by earlier versions, which know fewer.
std::string changed_settings_json(const settings::RunSettings& settings);

} // namespace octant::ui::sweep
