#pragma once

#include "tests/fuzz/obj_polygons.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace octant::tests::fuzz {

/// How a model fared, from the worst.
enum class Outcome {
    Crash,        ///< ended by a signal other than the next two
    Abort,        ///< an assertion or an exception that nobody caught
    Timeout,      ///< used up its CPU seconds
    Refused,      ///< the reader or the builder threw Error
    BadSequence,  ///< an eye's sequence repeats a polygon or names one that is not there
    WrongOrder,   ///< the ordered model shows a farther polygon before a nearer one
    WrongPicture, ///< the picture is not that of the given model
    WrongDecal,   ///< of two polygons in one plane the earlier one of the file is seen
    NotProved,    ///< its certificate has gaps or is refused
    Right
};

inline constexpr std::array<std::string_view, 10> outcome_names{"crash", "abort", "timeout", "refused", "bad-sequence",
    "wrong-order", "wrong-picture", "wrong-decal", "not-proved", "right"};

inline std::string_view name_of(Outcome outcome) { return outcome_names[static_cast<std::size_t>(outcome)]; }

struct TrialOptions {
    int rays = 4000;
    int cpu_s = 60;         ///< of one trial, all threads together
    double order_s = 20.0;  ///< OrderOptions::seconds
    std::uint64_t seed = 1; ///< of the rays
    bool certify = false;   ///< also write a certificate and verify it without rounding
};

struct TrialResult {
    Outcome outcome = Outcome::Right;
    long polygons = 0; ///< as read
    long pieces = 0;   ///< of the ordered model
    long cells = 0;
    double build_s = 0.0;
    long hits = 0;
    long open = 0;    ///< rays that margins left open
    long wrong = 0;   ///< rays
    std::string what; ///< of a failure; empty if right
};

/// Reads, orders and checks a model in a child process of its own, so that nothing it does harms the caller. Throws
/// Error when no child can be started.
TrialResult tried(const ObjPolygons& model, const TrialOptions& options);

} // namespace octant::tests::fuzz
