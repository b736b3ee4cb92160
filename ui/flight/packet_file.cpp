#include "ui/flight/packet_file.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/links/wire_bytes.h"
#include "sim/sun_position.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace octant::ui::flight {

namespace links = sim::links;

namespace {

enum class RecordKind : std::uint8_t { Packet = 1, Words = 2, Picture = 3, TimeOfDay = 4 };

constexpr std::string_view magic = "octant packets 1 ";
constexpr std::string_view none = "-";
constexpr std::size_t largest_bytes = std::size_t{1} << 32U;
constexpr std::size_t max_bytes_a_record = 65536;
/// The longest recording that is read.
constexpr double longest_s = 1e7;

std::string_view text_of(links::Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; // NOLINT
}

std::optional<std::size_t> number_up_to(std::string_view text, std::size_t most) {
    std::size_t number = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    return read.ec == std::errc() && read.ptr == end && number <= most ? std::optional(number) : std::nullopt;
}

links::Bytes bytes_of(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }

/// Reads records one behind the other; stops at one that is not whole.
class RecordReader {
public:
    RecordReader(const std::filesystem::path& file, links::Bytes bytes)
        : file_(file), reader_(bytes, links::ByteOrder::Big), bytes_(bytes) {}

    /// The frames that are whole.
    std::vector<PacketFrame> frames() {
        std::vector<PacketFrame> frames;
        PacketFrame frame;
        while (next(frame)) {
            if (complete_) {
                frames.push_back(std::exchange(frame, {}));
                complete_ = false;
            }
        }
        return frames;
    }

private:
    template <class Number>
    std::optional<Number> number() {
        if (bytes_.size() - at_ < sizeof(Number)) { return std::nullopt; }
        const auto value = reader_.at<Number>(at_);
        at_ += sizeof(Number);
        return value;
    }

    std::optional<links::Bytes> block() {
        const auto size = number<std::uint32_t>();
        if (!size) { return std::nullopt; }
        if (*size > max_bytes_a_record) {
            throw_bad_record(fmt::format("a record of at most {} bytes, got {}", max_bytes_a_record, *size));
        }
        if (bytes_.size() - at_ < *size) { return std::nullopt; }
        const links::Bytes block = bytes_.subspan(at_, *size);
        at_ += *size;
        return block;
    }

    bool next(PacketFrame& frame) {
        const auto kind = number<std::uint8_t>();
        if (!kind) { return false; }
        switch (RecordKind{*kind}) {
        case RecordKind::Packet:
            return next_packet(frame);
        case RecordKind::Words:
            return next_words(frame);
        case RecordKind::TimeOfDay:
            return next_time_of_day(frame);
        case RecordKind::Picture: {
            const auto time_s = number<double>();
            if (time_s && !(*time_s > last_s_ && *time_s <= longest_s)) {
                throw_bad_record(
                    fmt::format("a picture after {} s and up to {} s, got {}", last_s_, longest_s, *time_s));
            }
            complete_ = time_s.has_value();
            last_s_ = frame.time_s = time_s.value_or(0.0);
            return complete_;
        }
        }
        throw_bad_record(fmt::format("a record of kind 1 to 4, got {}", *kind));
    }

    bool next_packet(PacketFrame& frame) {
        const auto protocol = number<std::uint8_t>();
        const auto address = number<std::uint32_t>();
        const auto port = number<std::uint16_t>();
        const auto arrival_s = number<double>();
        const auto bytes = block();
        if (!protocol || !address || !port || !arrival_s || !bytes) { return false; }
        if (!(std::abs(*arrival_s) <= longest_s)) {
            throw_bad_record(fmt::format("a time of arrival up to {} s, got {}", longest_s, *arrival_s));
        }
        frame.packets.push_back(
            {links::Protocol{*protocol}, {*address, *port}, *arrival_s, {bytes->begin(), bytes->end()}});
        return true;
    }

    bool next_words(PacketFrame& frame) {
        const auto bytes = block();
        if (!bytes) { return false; }
        frame.has_overlay_lines = true;
        for (const std::string_view line : split_lines(text_of(*bytes))) { frame.overlay_lines.emplace_back(line); }
        return true;
    }

    bool next_time_of_day(PacketFrame& frame) {
        const auto bytes = block();
        if (!bytes) { return false; }
        frame.time_of_day = text_of(*bytes);
        if (!sim::solar_time_from_text(frame.time_of_day)) {
            throw_bad_record(fmt::format("a time as YYYY-MM-DDTHH:MM, got '{}'", printable(frame.time_of_day)));
        }
        return true;
    }

    [[noreturn]] void throw_bad_record(const std::string& expected) const {
        throw_error_in(file_, fmt::format("byte {}: expected {}", at_, expected));
    }

    const std::filesystem::path& file_;
    links::WireReader reader_;
    links::Bytes bytes_;
    std::size_t at_ = 0;
    double last_s_ = -1.0;
    bool complete_ = false;
};

/// "TYPE=AIRCRAFT,TYPE=AIRCRAFT" or none; nothing for other text.
std::optional<std::map<std::uint16_t, std::size_t>> shapes_from(std::string_view word) {
    std::map<std::uint16_t, std::size_t> shapes;
    for (const std::string_view pair : word == none ? std::vector<std::string_view>() : split_fields(word, ',')) {
        const auto sides = split_fields(pair, '=');
        const auto type = number_up_to(sides.front(), std::numeric_limits<std::uint16_t>::max());
        const auto aircraft = number_up_to(sides.back(), links::LiveTraffic::max_vehicles);
        if (sides.size() != 2 || !type || !aircraft) { return std::nullopt; }
        shapes.emplace(static_cast<std::uint16_t>(*type), *aircraft);
    }
    return shapes;
}

/// Nothing where no value has that name.
template <class Enum>
std::optional<Enum> value_of(std::string_view name) {
    const auto names = settings::names_of<Enum>();
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? std::nullopt : std::optional(static_cast<Enum>(found - names.begin()));
}

std::string text_of(const LiveOptions& options) {
    std::vector<std::string> shapes;
    for (const auto& [type, aircraft] : options.shapes) { shapes.push_back(fmt::format("{}={}", type, aircraft)); }
    return fmt::format("{} {} {} {} {} {}", options.delay_s,
        options.height ? settings::name_of(*options.height) : "usual", options.step ? "step" : "clock",
        settings::name_of(options.channel), options.view ? fmt::format("{}", *options.view) : std::string(none),
        shapes.empty() ? std::string(none) : fmt::format("{}", fmt::join(shapes, ",")));
}

LiveOptions options_of(const std::filesystem::path& file, std::string_view line) {
    const auto overlay_lines = split_words(line);
    constexpr std::size_t most = 6; // older files have fewer
    const bool has_channel = overlay_lines.size() > 3;
    const auto delay_s =
        overlay_lines.size() >= 3 && overlay_lines.size() <= most ? finite_number(overlay_lines[0]) : std::nullopt;
    const auto channel = has_channel ? value_of<LiveChannel>(overlay_lines[3]) : LiveChannel::Front;
    const std::string_view view = overlay_lines.size() > 4 ? overlay_lines[4] : none;
    const auto number = number_up_to(view, std::numeric_limits<std::uint16_t>::max());
    const auto shapes = shapes_from(overlay_lines.size() == most ? overlay_lines[most - 1] : none);
    if (!delay_s || !channel || (!number && view != none) || !shapes) {
        throw_error_at(file, 1,
            fmt::format("expected a delay, a height, a step, a channel, a view and shapes, got '{}'",
                printable(std::string(line))));
    }
    return {*delay_s, value_of<LiveHeightMode>(overlay_lines[1]), overlay_lines[2] == "step", *channel,
        number ? std::optional(static_cast<int>(*number)) : std::nullopt, *shapes};
}

std::string text_record(RecordKind kind, std::string_view text) {
    links::WireWriter record(links::ByteOrder::Big);
    record.add(static_cast<std::uint8_t>(kind));
    record.add(static_cast<std::uint32_t>(text.size()));
    return fmt::format("{}{}", text_of(record.bytes()), text);
}

} // namespace

PacketWriter::PacketWriter(const std::filesystem::path& folder, const LiveOptions& options)
    : file_(folder / packets_file_name) {
    file_.append(fmt::format("{}{}\n", magic, text_of(options)));
    file_.flush();
}

void PacketWriter::add(const links::Datagram& packet) {
    links::WireWriter record(links::ByteOrder::Big);
    record.add(static_cast<std::uint8_t>(RecordKind::Packet));
    record.add(static_cast<std::uint8_t>(packet.protocol));
    record.add(packet.source.address);
    record.add(packet.source.port);
    record.add(packet.arrival_s);
    record.add(static_cast<std::uint32_t>(packet.bytes.size()));
    file_.append(text_of(record.bytes()));
    file_.append(text_of(packet.bytes));
}

void PacketWriter::add_overlay_lines(const std::vector<std::string>& overlay_lines) {
    file_.append(text_record(RecordKind::Words, fmt::format("{}", fmt::join(overlay_lines, "\n"))));
}

void PacketWriter::add_time_of_day(const std::string& time_of_day) {
    file_.append(text_record(RecordKind::TimeOfDay, time_of_day));
}

void PacketWriter::add_picture(double time_s) {
    links::WireWriter record(links::ByteOrder::Big);
    record.add(static_cast<std::uint8_t>(RecordKind::Picture));
    record.add(time_s);
    file_.append(text_of(record.bytes()));
    constexpr long flushed_every = 30;
    if (++pictures_ % flushed_every == 0) { file_.flush(); }
}

void PacketWriter::finish() { file_.flush(); }

PacketFile read_packets(const std::filesystem::path& folder) {
    const auto file = folder / packets_file_name;
    const std::string bytes = read_file(file, largest_bytes);
    const std::string_view text = bytes;
    const std::size_t head = text.find('\n');
    if (!text.starts_with(magic) || head == std::string_view::npos) {
        throw_error_at(file, 1, fmt::format("expected '{}', got another beginning", magic));
    }
    PacketFile packets;
    packets.options = options_of(file, text.substr(magic.size(), head - magic.size()));
    RecordReader reader(file, bytes_of(text.substr(head + 1)));
    packets.frames = reader.frames();
    return packets;
}

} // namespace octant::ui::flight
