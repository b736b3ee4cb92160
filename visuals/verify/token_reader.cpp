#include "visuals/verify/token_reader.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <cstdint>
#include <fmt/format.h>

namespace octant::visuals::verify {

bool TokenReader::set_line(std::string_view line) {
    ++line_;
    words_ = split_words(line.substr(0, line.find('#')));
    at_ = 0;
    return !words_.empty();
}

void TokenReader::refuse(const std::string& expected) const {
    const std::string got =
        done() ? "none" : fmt::format("'{}'", printable(std::string(words_[at_])));
    throw_error_at(path_, line_, fmt::format("expected {}, got {}", expected, got));
}

void TokenReader::fail_at_last(const std::string& expected) {
    --at_;
    refuse(expected);
}

bool TokenReader::skip(std::string_view word) {
    const bool there = !done() && words_[at_] == word;
    at_ += there ? 1 : 0;
    return there;
}

std::string_view TokenReader::word(std::string_view what) {
    if (done()) {
        refuse(std::string(what));
    }
    return words_[at_++];
}

double TokenReader::number(std::string_view what, double least, double most) {
    const auto value = done() ? std::nullopt : finite_number(words_[at_]);
    if (!value || *value < least || *value > most) {
        refuse(fmt::format("{} (a number from {:g} to {:g})", what, least, most));
    }
    ++at_;
    return *value;
}

std::uint32_t TokenReader::index(std::string_view what, std::size_t end) {
    const auto value = done() ? std::nullopt : whole_number(words_[at_]);
    if (!value || *value < 0 || static_cast<std::size_t>(*value) >= end) {
        refuse(
            end == 0 ? fmt::format("{}, of which there are none", what)
                     : fmt::format("{} (0 to {})", what, end - 1));
    }
    ++at_;
    return static_cast<std::uint32_t>(*value);
}

void TokenReader::end_of_line() const {
    if (!done()) {
        refuse("the end of the line");
    }
}

} // namespace octant::visuals::verify
