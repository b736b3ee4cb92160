#include "visuals/orderfile/order_tokens.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

namespace octant::visuals::orderfile {

namespace {

constexpr double largest_number = 1e12;
constexpr double min_length = 1e-12; ///< A normal or direction must be longer than this.

} // namespace

void OrderTokens::begin_line(std::string_view text) {
    ++line_;
    words_ = split_words(text.substr(0, text.find('#')));
    at_ = 0;
}

std::string OrderTokens::line() const {
    return fmt::format("{}", fmt::join(words_, " "));
}

void OrderTokens::refuse(const std::string& expected) const {
    const std::string got =
        has_more() ? fmt::format("'{}'", printable(std::string(peek()))) : "none";
    throw_error_at(path_, line_, fmt::format("expected {}, got {}", expected, got));
}

bool OrderTokens::skip(std::string_view word) {
    const bool there = next_is(word);
    at_ += there ? 1 : 0;
    return there;
}

double OrderTokens::number(const char* what) {
    const auto value = has_more() ? finite_number(peek()) : std::nullopt;
    if (!value || std::abs(*value) > largest_number) {
        refuse(fmt::format("{} (a number within {:g})", what, largest_number));
    }
    ++at_;
    return *value;
}

glm::dvec3 OrderTokens::vector(const char* what) {
    const double x = number(what);
    const double y = number(what);
    const double z = number(what);
    return axes_.body_from_file({x, y, z});
}

glm::dvec3 OrderTokens::nonzero_vector(const char* what) {
    const glm::dvec3 v = vector(what);
    if (glm::length(v) < min_length) {
        --at_;
        refuse(fmt::format("{} with a length", what));
    }
    return v;
}

long OrderTokens::count(const char* what, long least, long most) {
    const auto value = has_more() ? whole_number(peek()) : std::nullopt;
    if (!value || *value < least || *value > most) {
        refuse(fmt::format("{} ({} to {})", what, least, most));
    }
    ++at_;
    return *value;
}

double OrderTokens::min_zero(const char* what) {
    const double value = number(what);
    if (value < 0.0) {
        --at_;
        refuse(fmt::format("{} of 0 or more", what));
    }
    return value;
}

Plane OrderTokens::plane() {
    const glm::dvec3 normal = nonzero_vector("a normal");
    const double length = glm::length(normal);
    // A unit vector stays as written, bit for bit.
    const double factor = std::abs(length - 1.0) < 1e-14 ? 1.0 : 1.0 / length;
    return {normal * factor, number("an offset") * factor};
}

} // namespace octant::visuals::orderfile
