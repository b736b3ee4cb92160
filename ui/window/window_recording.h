#pragma once

#include "sim/base/output_file.h"
#include "ui/flight/session.h"
#include "ui/report/recording_writer.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace octant::ui::window {

/// Records a flight in a window. The run.json of the recording flies the same simulation steps again without a window.
/// It flies along the path, from where the recording began and for as long as it took; a flight that was by hand for
/// any time is flown along flight.csv, which holds the state at every step.
class WindowRecording {
public:
    /// Begins with the session's last simulation step. Throws Error.
    WindowRecording(std::filesystem::path folder, flight::Session& session);

    /// Takes the frame that the session has just drawn. A picture is kept every simulated second. Throws Error (disk
    /// full).
    void add(report::FrameRecord record, flight::Session& session);

    /// Ends with the last picture and returns the line that says where the report is. Throws Error.
    std::string finish(flight::Session& session);

    const std::filesystem::path& folder() const { return recording_.folder(); }

    /// Returns the simulated time up to the last picture.
    double length_s() const;

private:
    void append_states(flight::Session& session);
    settings::RunSettings settings_to_repeat(flight::Session& session) const;
    std::size_t states_to_the_end(flight::Session& session) const;

    long first_step_;
    report::RecordingWriter recording_;
    bool by_hand_;
    std::optional<AppendedFile> flight_; ///< flight.csv
    std::size_t states_written_ = 0;
    int frames_ = 0;
    /// The next picture may have been simulated before the beginning of the recording.
    bool first_is_older_ = true;
    double last_time_s_;
    std::uint64_t last_hash_;
    double next_picture_s_;
    double flushed_wall_s_ = 0.0;
};

} // namespace octant::ui::window
