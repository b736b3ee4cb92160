#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/fuzz/fuzz_options.h"
#include "tests/fuzz/kinds.h"
#include "tests/fuzz/painting_check.h"
#include "tests/fuzz/reducer.h"
#include "tests/fuzz/trial.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <span>
#include <string>

namespace octant::tests::fuzz {

namespace {

constexpr int min_polygons = 6;
constexpr int max_polygons = 60;

/// How the cases of one kind fared.
struct Tally {
    std::array<long, outcome_names.size()> cases{};
    long hits = 0;
    long open = 0;
    double longest_s = 0.0;
};

class Fuzzing {
public:
    explicit Fuzzing(const FuzzOptions& options) : options_(options) {}

    /// Exit code.
    int run() {
        if (!options_.files.empty()) {
            for (const std::filesystem::path& file : options_.files) {
                one("files", file.string(), read_obj_polygons(file));
            }
        } else if (options_.only) {
            round(*options_.only);
        } else {
            made_ones();
        }
        summary();
        return failures_ > 0 ? 1 : 0;
    }

private:
    bool may_go_on() const {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
        return options_.cases ? cases_ < *options_.cases : spent.count() < options_.seconds;
    }

    void made_ones() {
        for (std::uint64_t seed = options_.seed; may_go_on(); ++seed) { round(seed); }
    }

    /// One case of each kind.
    void round(std::uint64_t seed) {
        const int by_seed = min_polygons + static_cast<int>(seed * 7919U % (max_polygons - min_polygons + 1));
        for (const std::string& kind : options_.kinds) {
            if (!options_.only && !may_go_on()) { return; }
            one(kind, fmt::format("{} {}", kind, seed), made_model(kind, seed, options_.polygons.value_or(by_seed)));
        }
    }

    void one(const std::string& kind, const std::string& name, const ObjPolygons& model) {
        const TrialResult result = tried(model, options_.trial);
        ++cases_;
        Tally& tally = tallies_[kind];
        ++tally.cases[static_cast<std::size_t>(result.outcome)];
        tally.hits += result.hits;
        tally.open += result.open;
        tally.longest_s = std::max(tally.longest_s, result.build_s);
        const bool failed = result.outcome != Outcome::Right;
        if (failed || options_.verbose) {
            fmt::print("{}: {}, polygons {} -> {}, cells {}, build {:.3f} s, {} of {} rays wrong{}{}\n", name,
                name_of(result.outcome), result.polygons, result.pieces, result.cells, result.build_s, result.wrong,
                result.hits, failed ? ": " : "", result.what);
            std::fflush(stdout);
        }
        if (failed) {
            ++failures_;
            keep(name, model, result);
        }
    }

    void keep(const std::string& name, const ObjPolygons& model, const TrialResult& result) {
        if (options_.keep.empty()) { return; }
        std::filesystem::create_directories(options_.keep);
        const ObjPolygons less = options_.whole ? model : reduced(model, result.outcome, options_.trial);
        std::string stem = std::filesystem::path(name).stem().string();
        std::ranges::replace(stem, ' ', '-');
        const std::filesystem::path file = options_.keep / fmt::format("{}-{}.obj", name_of(result.outcome), stem);
        write_file(file, text_of(less, fmt::format("{} of {}", name_of(result.outcome), name)));
        fmt::print("  kept {} polygons of it: {}\n", less.polygons.size(), file.string());
        std::fflush(stdout);
    }

    void summary() const {
        fmt::print("{:<12}{:>8}", "kind", "cases");
        for (const std::string_view name : outcome_names) { fmt::print("{:>14}", name); }
        fmt::print("{:>10}{:>9}{:>11}\n", "hits", "open", "longest s");
        for (const auto& [kind, tally] : tallies_) {
            long cases = 0;
            for (const long count : tally.cases) { cases += count; }
            fmt::print("{:<12}{:>8}", kind, cases);
            for (const long count : tally.cases) { fmt::print("{:>14}", count); }
            fmt::print("{:>10}{:>9}{:>11.2f}\n", tally.hits, tally.open, tally.longest_s);
        }
        fmt::print("{} of {} cases failed. Left open: what moving polygons by {:g} of the size could "
                   "change, "
                   "against the given model by {:g}.\n",
            failures_, cases_, order_margin_sizes, picture_margin_sizes);
    }

    const FuzzOptions& options_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::map<std::string, Tally> tallies_;
    long cases_ = 0;
    long failures_ = 0;
};

int run(std::span<char* const> words) {
    try {
        const auto options = read_fuzz_options(words);
        if (!options) {
            fmt::print("{}", help_text());
            return 0;
        }
        return Fuzzing(*options).run();
    } catch (const Error& error) {
        fmt::print(stderr, "draw_order_fuzz: {}\n", error.what());
        return 2;
    }
}

} // namespace

} // namespace octant::tests::fuzz

int main(int count, char** words) { return octant::tests::fuzz::run({words + 1, static_cast<std::size_t>(count - 1)}); }
