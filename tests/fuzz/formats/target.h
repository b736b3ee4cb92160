#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace octant::tests::formats {

/// A file format, and all that the program does with a file of it before anything is drawn.
struct Target {
    std::string name;
    /// The file's name; its ending may say the format. Empty for a packet.
    std::string file{};
    /// Reads the file and uses its content. Throws octant::Error for a file that is refused and Finding for what must
    /// never happen; any other exception is a finding, too.
    std::function<void(const std::filesystem::path& file)> use{};
    /// For a packet, in place of `use`: decodes its bytes, which lie in a block of their own size so that a sanitizer
    /// sees reads beyond it. Throws Finding only.
    std::function<void(std::span<const std::byte> packet)> decode{};
    /// Valid inputs, small, which together reach all of the reader.
    std::function<std::vector<std::string>()> seeds;
    /// Words of the format, for mutations.
    std::vector<std::string> words{};
    /// Makes lengths and checksums those of the bytes, so that mutations reach what lies behind them. Each input is
    /// tried as it is and sealed.
    std::function<void(std::string& bytes)> seal{};
    /// The number of mutations that format_replay tries unless it is told.
    std::uint64_t mutations = 3000;
};

/// What must never be, whatever a file holds.
class Finding : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Throws Finding unless it is so.
void expect(bool so, const std::string& otherwise);

/// Adds a target to those of the program; made once for each, before main().
class Registered {
public:
    explicit Registered(Target target);
};

/// All targets of the program, by name.
std::span<const Target> targets();

/// A folder of this process for inputs, in memory where the system has such a place; removed when the process ends as
/// it should.
const std::filesystem::path& input_folder();

/// Why `use` refused the bytes; empty when it took them, as they are or sealed. Throws Finding for a message that is
/// not one line of printable text that begins with the file, and whatever else `use` throws.
std::string tried(const Target& target, std::string_view bytes);

/// What `write` writes into a file of this name.
std::string bytes_written(const std::string& name, const std::function<void(const std::filesystem::path& file)>& write);

} // namespace octant::tests::formats
