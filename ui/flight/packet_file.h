#pragma once

#include "sim/base/output_file.h"
#include "sim/links/udp_port.h"
#include "ui/flight/live_flight.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace octant::ui::flight {

/// The file of a live recording that repeats it: packets.bin beside run.json.
inline constexpr const char* packets_file_name = "packets.bin";

/// Writes what a live flight was made of, as it comes: a line of text with the options, then records of packets, of
/// lines written into pictures, of times of day that the sun shows, and of pictures with their times. Numbers are
/// big-endian.
class PacketWriter {
public:
    /// Makes the file. Throws Error.
    PacketWriter(const std::filesystem::path& folder, const LiveOptions& options);

    void add(const sim::links::Datagram& packet);
    void add_overlay_lines(const std::vector<std::string>& overlay_lines);
    void add_time_of_day(const std::string& time_of_day);

    /// The picture for which all that was added since the last one counts. Throws Error (disk full).
    void add_picture(double time_s);

    /// Throws Error (disk full).
    void finish();

private:
    AppendedFile file_;
    long pictures_ = 0;
};

/// What a picture of a live recording was made of.
struct PacketFrame {
    double time_s = 0.0;
    std::vector<sim::links::Datagram> packets;
    bool has_overlay_lines = false;
    std::vector<std::string> overlay_lines;
    /// What the sun shows from this picture on; empty = as before.
    std::string time_of_day;
};

/// A live recording, read again.
struct PacketFile {
    LiveOptions options;
    std::vector<PacketFrame> frames;
};

/// Reads it; what a killed flight left unfinished at its end is left out. Throws Error for a file that is damaged.
PacketFile read_packets(const std::filesystem::path& folder);

} // namespace octant::ui::flight
