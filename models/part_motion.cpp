#include "models/part_motion.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace octant::models {

namespace {

double amount_at(const PartMove& move, double position) {
    const auto next = std::ranges::upper_bound(move.amounts, position, {}, &glm::dvec2::x);
    if (next == move.amounts.begin()) { return next == move.amounts.end() ? 0.0 : next->y; }
    const glm::dvec2& before = *std::prev(next);
    if (next == move.amounts.end()) { return before.y; }
    return before.y + (position - before.x) / (next->x - before.x) * (next->y - before.y);
}

/// Leaves out what lies on the straight line between its neighbours.
std::vector<glm::dvec2> without_middles(const std::vector<glm::dvec2>& amounts) {
    std::vector<glm::dvec2> kept;
    for (std::size_t i = 0; i < amounts.size(); ++i) {
        if (i > 0 && i + 1 < amounts.size()) {
            const glm::dvec2 way = amounts[i + 1] - kept.back();
            const double line = kept.back().y + way.y * (amounts[i].x - kept.back().x) / way.x;
            if (std::abs(line - amounts[i].y) < 1e-9) { continue; }
        }
        kept.push_back(amounts[i]);
    }
    return kept;
}

} // namespace

double least_position(FlightControl control) {
    return control == FlightControl::Roll || control == FlightControl::Pitch || control == FlightControl::Yaw ? -1.0
                                                                                                              : 0.0;
}

std::optional<PartMove> sampled_move(
    PartMove::Kind kind, FlightControl control, const std::function<double(double)>& amount_of) {
    constexpr int steps = 20;
    const bool shows = kind == PartMove::Kind::Show;
    const double at_rest = shows ? 0.0 : amount_of(0.0);
    PartMove move;
    move.kind = kind;
    move.control = control;
    bool does_something = false;
    for (int step = least_position(control) < 0.0 ? -steps : 0; step <= steps; ++step) {
        const double position = static_cast<double>(step) / steps;
        const double amount = amount_of(position) - at_rest;
        does_something = does_something || amount != (shows ? 1.0 : 0.0);
        move.amounts.emplace_back(position, amount);
    }
    if (!does_something) { return std::nullopt; }
    move.amounts = without_middles(move.amounts);
    return move;
}

glm::dmat4 placement_by(std::span<const PartMove> moves, const ControlPositions& positions) {
    glm::dmat4 placement(1.0);
    for (const PartMove& move : moves) {
        const double amount = amount_at(move, positions[static_cast<std::size_t>(move.control)]);
        if (move.kind == PartMove::Kind::Shift) {
            placement = glm::translate(placement, amount * move.direction);
        } else if (move.kind == PartMove::Kind::Turn) {
            placement = glm::translate(placement, move.point_m);
            placement = glm::translate(glm::rotate(placement, amount, move.direction), -move.point_m);
        } else if (amount < 0.5) {
            return glm::dmat4(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        }
    }
    return placement;
}

bool is_shown_at_rest(std::span<const PartMove> moves) {
    return std::ranges::none_of(
        moves, [](const PartMove& move) { return move.kind == PartMove::Kind::Show && amount_at(move, 0.0) < 0.5; });
}

} // namespace octant::models
