// format_replay: tries every format's seeds, what was found once, and mutations of both, which are the same in every
// run. Exit code 0: no finding; 1: a finding; 2: wrong options.
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/fuzz/formats/mutation.h"
#include "tests/fuzz/formats/target.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <unistd.h>
#include <utility>

namespace {

using namespace octant;
using namespace octant::tests::formats;
namespace fs = std::filesystem;

/// What format_replay is asked for.
struct ReplayOptions {
    std::string only;                       ///< name of a target; empty = all
    std::optional<std::uint64_t> mutations; ///< replaces the targets' numbers
    std::uint64_t seed = 1;
    std::vector<std::filesystem::path> files;    ///< inputs to try in place of mutations
    std::optional<std::filesystem::path> corpus; ///< where to write seeds and words for libFuzzer
};

std::uint64_t count_of(const std::string& option, const std::string& text) {
    const auto value = whole_number(text);
    if (!value || *value < 0) { throw Error(option + ": expected a whole number from 0 on, got " + printable(text)); }
    return static_cast<std::uint64_t>(*value);
}

/// Reads the command line. Throws Error for options that are not known or lack a value.
ReplayOptions read_replay_options(std::span<char* const> words) {
    ReplayOptions options;
    for (std::size_t i = 0; i < words.size(); i += 2) {
        const std::string option = words[i];
        if (i + 1 == words.size()) { throw Error(option + ": expected a value, got none"); }
        const std::string value = words[i + 1];
        if (option == "--only") {
            options.only = value;
        } else if (option == "--mutations") {
            options.mutations = count_of(option, value);
        } else if (option == "--seed") {
            options.seed = count_of(option, value);
        } else if (option == "--file") {
            options.files.emplace_back(value);
        } else if (option == "--write-corpus") {
            options.corpus = value;
        } else {
            throw Error("expected --only, --mutations, --seed, --file or --write-corpus, got " + option);
        }
    }
    return options;
}

/// What is being tried, for the last words of a crash.
std::array<char, 512> now_trying{};

void tell_crash(int signal_number) {
    [[maybe_unused]] const auto told = ::write(2, now_trying.data(), std::string_view(now_trying.data()).size());
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
}

void say_what_is_tried(const std::string& what) {
    const std::string line = "crash: " + what + "; the input is in " + input_folder().string() + "\n";
    *std::copy_n(line.begin(), std::min(line.size(), now_trying.size() - 1), now_trying.begin()) = '\0';
}

std::vector<std::string> found_once(const Target& target) {
    std::vector<fs::path> files;
    const fs::path folder = fs::path(OCTANT_SOURCE_DIR "/tests/fuzz/formats/found") / target.name;
    if (fs::is_directory(folder)) {
        for (const auto& entry : fs::directory_iterator(folder)) { files.push_back(entry.path()); }
    }
    std::ranges::sort(files);
    std::vector<std::string> all;
    std::ranges::transform(files, std::back_inserter(all), [](const fs::path& file) { return read_file(file); });
    return all;
}

/// The trial of one target, and its counts.
class Replay {
public:
    explicit Replay(const Target& target) : target_(target) {}

    /// Why the bytes were refused, if they were; a finding is told, and its input kept.
    std::string one(const std::string& bytes, const std::string& what) {
        say_what_is_tried(target_.name + ", " + what);
        std::string refusal;
        try {
            refusal = tried(target_, bytes);
        } catch (const std::exception& finding) {
            const std::string kept = fmt::format("finding-{}-{}", target_.name, findings_++);
            write_file(kept, bytes);
            fmt::print("{}, {}: {}; input kept as {}\n", target_.name, what, finding.what(), kept);
        }
        ++(refusal.empty() ? taken_ : refused_);
        return refusal;
    }

    /// Seeds must be taken: else they reach no further than the parser.
    void seeds(std::vector<std::string> all) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::string refusal = one(all[i], fmt::format("seed {}", i));
            if (!refusal.empty()) {
                fmt::print("{}: expected seed {} to be taken, got: {}\n", target_.name, i, refusal);
                ++findings_;
            }
        }
        seeds_ = std::move(all);
    }

    void mutations(std::uint64_t count, std::uint64_t seed) {
        Hash name;
        name.add(std::as_bytes(std::span(target_.name)));
        RandomGenerator dice(name.value() + seed);
        for (std::uint64_t i = 0; i < count && findings_ < 10; ++i) {
            one(mutated(seeds_, target_.words, dice), fmt::format("mutation {} of seed {}", i, seed));
        }
    }

    void add_seeds(const std::vector<std::string>& more) { seeds_.insert(seeds_.end(), more.begin(), more.end()); }

    int told() const {
        fmt::print("{}: {} taken, {} refused, {} findings\n", target_.name, taken_, refused_, findings_);
        return findings_;
    }

private:
    const Target& target_;
    std::vector<std::string> seeds_;
    int taken_ = 0;
    int refused_ = 0;
    int findings_ = 0;
};

int replay(const Target& target, const ReplayOptions& options) {
    Replay replay(target);
    for (const fs::path& file : options.files) { replay.one(read_file(file), file.string()); }
    if (options.files.empty()) {
        const std::vector<std::string> found = found_once(target);
        for (std::size_t i = 0; i < found.size(); ++i) { replay.one(found[i], fmt::format("found {}", i)); }
        replay.seeds(target.seeds());
        replay.add_seeds(found);
        replay.mutations(options.mutations.value_or(target.mutations), options.seed);
    }
    return replay.told();
}

/// FOLDER/NAME/seed-0 ..., and FOLDER/NAME.dict, as libFuzzer takes them.
void write_corpus(const Target& target, const fs::path& folder) {
    make_folder(folder / target.name);
    std::vector<std::string> all = target.seeds();
    std::ranges::copy(found_once(target), std::back_inserter(all));
    for (std::size_t i = 0; i < all.size(); ++i) {
        write_file(folder / target.name / fmt::format("seed-{}", i), all[i]);
    }
    std::string dictionary;
    for (const std::string& word : target.words) {
        dictionary += '"';
        for (const char c : word) { dictionary += fmt::format("\\x{:02x}", static_cast<unsigned char>(c)); }
        dictionary += "\"\n";
    }
    write_file(folder / (target.name + ".dict"), dictionary);
}

int run(const ReplayOptions& options) {
    int findings = 0;
    int known = 0;
    for (const Target& target : targets()) {
        if (!options.only.empty() && options.only != target.name) { continue; }
        ++known;
        if (options.corpus) {
            write_corpus(target, *options.corpus);
        } else {
            findings += replay(target, options);
        }
    }
    if (known == 0) { throw Error("--only: expected the name of a format, got " + printable(options.only)); }
    return findings == 0 ? 0 : 1;
}

} // namespace

int main(int count, char** words) {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    for (const int crash : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) { std::signal(crash, tell_crash); }
    try {
        return run(read_replay_options({words + 1, static_cast<std::size_t>(count) - 1}));
    } catch (const Error& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 2;
    }
}
