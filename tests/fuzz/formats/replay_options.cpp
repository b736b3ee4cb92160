#include "tests/fuzz/formats/replay_options.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

namespace octant::tests::formats {

namespace {

std::uint64_t count_of(const std::string& option, const std::string& text) {
    const auto value = whole_number(text);
    if (!value || *value < 0) { throw Error(option + ": expected a whole number from 0 on, got " + printable(text)); }
    return static_cast<std::uint64_t>(*value);
}

} // namespace

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

} // namespace octant::tests::formats
