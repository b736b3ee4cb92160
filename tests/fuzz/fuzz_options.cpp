#include "tests/fuzz/fuzz_options.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "tests/fuzz/kinds.h"
#include "tests/fuzz/painting_check.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>

namespace octant::tests::fuzz {

namespace {

class Words {
public:
    explicit Words(std::span<char* const> words) : words_(words) {}

    bool done() const { return at_ == words_.size(); }

    std::string_view next() { return words_[at_++]; }

    std::string_view value(std::string_view option) {
        if (done()) { throw Error(fmt::format("{}: expected a value, got none", option)); }
        return next();
    }

    double number(std::string_view option) {
        const std::string_view text = value(option);
        const auto number = finite_number(text);
        if (!number || *number < 0.0) {
            throw Error(fmt::format("{}: expected a number >= 0, got '{}'", option, text));
        }
        return *number;
    }

    long whole(std::string_view option) {
        const std::string_view text = value(option);
        const auto number = whole_number(text);
        if (!number || *number < 0) {
            throw Error(fmt::format("{}: expected a whole number >= 0, got '{}'", option, text));
        }
        return *number;
    }

private:
    std::span<char* const> words_;
    std::size_t at_ = 0;
};

std::string known_kind(std::string_view name) {
    const auto names = kind_names();
    if (std::ranges::find(names, name) == names.end()) {
        throw Error(fmt::format("--kind: expected one of {}, got '{}'", names, name));
    }
    return std::string(name);
}

void take(FuzzOptions& options, std::string_view option, Words& words) {
    if (option == "--seconds") {
        options.seconds = words.number(option);
    } else if (option == "--cases") {
        options.cases = words.whole(option);
    } else if (option == "--seed") {
        options.seed = static_cast<std::uint64_t>(words.whole(option));
    } else if (option == "--only") {
        options.only = static_cast<std::uint64_t>(words.whole(option));
    } else if (option == "--kind") {
        options.kinds.push_back(known_kind(words.value(option)));
    } else if (option == "--polygons") {
        options.polygons = static_cast<int>(words.whole(option));
    } else if (option == "--rays") {
        options.trial.rays = static_cast<int>(words.whole(option));
    } else if (option == "--order-seconds") {
        options.trial.order_s = words.number(option);
    } else if (option == "--cpu-seconds") {
        options.trial.cpu_s = static_cast<int>(words.whole(option));
    } else if (option == "--certify") {
        options.trial.certify = true;
    } else if (option == "--keep") {
        options.keep = words.value(option);
    } else if (option == "--whole") {
        options.whole = true;
    } else if (option == "--verbose") {
        options.verbose = true;
    } else if (option == "--obj") {
        while (!words.done()) { options.files.emplace_back(words.next()); }
    } else {
        throw Error(fmt::format("expected an option (see --help), got '{}'", option));
    }
}

} // namespace

std::string help_text() {
    return fmt::format("Makes models that are hard to order, orders them and checks the painting by rays.\n"
                       "  --seconds N      wall time, 10 at first\n"
                       "  --cases N        so many cases instead\n"
                       "  --seed S         seed of the first case, 1 at first; the next cases count on\n"
                       "  --only S         the case of this seed only, for each kind\n"
                       "  --kind KIND      again for more: {}; all at first\n"
                       "  --polygons N     about so many in a model; 6 to 60 at first\n"
                       "  --rays N         for each case, 4000 at first\n"
                       "  --order-seconds N  of search for each order, 20 at first\n"
                       "  --cpu-seconds N  for each case, 60 at first\n"
                       "  --certify        also prove each order right, without rounding\n"
                       "  --keep DIR       write failing models there, reduced\n"
                       "  --whole          do not reduce them\n"
                       "  --verbose        a line a case, good ones too\n"
                       "  --obj FILE...    check these models instead; the last option\n"
                       "Left open are rays that another answer fits where each polygon is moved by {:g} of the "
                       "model's\nsize; against the given model by {:g} and by as much as it is bent. "
                       "Exit code 1: a case failed.\n",
        fmt::join(kind_names(), ", "), order_margin_sizes, picture_margin_sizes);
}

std::optional<FuzzOptions> read_fuzz_options(std::span<char* const> given) {
    FuzzOptions options;
    Words words(given);
    while (!words.done()) {
        const std::string_view option = words.next();
        if (option == "--help") { return std::nullopt; }
        take(options, option, words);
    }
    if (options.kinds.empty()) {
        for (const std::string_view name : kind_names()) { options.kinds.emplace_back(name); }
    }
    return options;
}

} // namespace octant::tests::fuzz
