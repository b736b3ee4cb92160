#pragma once

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
    /// What the file is called; its ending may say the format.
    std::string file;
    /// Reads the file and uses what was in it. Throws octant::Error for a file that is refused and Finding for what
    /// must never be; anything else that it throws is a finding, too.
    std::function<void(const std::filesystem::path& file)> use;
    /// Sound files, small, which together reach all of the reader.
    std::function<std::vector<std::string>()> seeds;
    /// Words of the format, for mutations.
    std::vector<std::string> words{};
    /// Makes lengths and checksums those of the bytes, so that mutations reach what lies behind them. Each input is
    /// tried as it is and sealed.
    std::function<void(std::string& bytes)> seal{};
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
