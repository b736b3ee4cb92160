#pragma once

#include "ui/commands/option.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/listener.h"
#include "ui/settings/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

/// What `octant listen` is asked for, in a window and without one.
struct ListenOptions {
    settings::RunSettings settings;
    flight::ListenerOptions listener;
    /// How many are shown, at least as many as there are aircraft; nothing = 16.
    std::optional<int> vehicles;
    std::optional<std::string> entities; ///< file of world::read_entity_table
    std::vector<std::string> send;       ///< to whom, as flight::Sender has it
    flight::RecordOptions record;        ///< without a window
    bool json = false;
    bool quiet = false;
};

/// The options of listening, without those of the settings, and the settings that count for a flight from outside.
std::vector<Option> listen_options(ListenOptions& options);

/// Shows what comes without a window, until as many frames or seconds have passed as the settings say or a stop signal
/// comes, completes the recording and prints a summary. Throws Error.
void listen_without_window(const ListenOptions& options);

} // namespace octant::ui::commands
