// Iterative refinement: A. Gleixner, D. Steffy, K. Wolter, "Iterative Refinement for Linear
// Programming", 2016. A solver keeps bounds within 1e-9. What it is off by is put under a
// magnifying glass and solved for again, with the same factors.
#include "visuals/separation/refined_optimum.h"

#include <cmath>
#include <utility>

namespace octant::visuals::separation {

namespace {

constexpr double magnification = 1e6;
constexpr int rounds = 1;

/// The programme of what is to be added to a solution, times `magnification`.
LinearProgram correction(const LinearProgram& program, const std::vector<double>& solution) {
    LinearProgram out = program;
    for (std::size_t i = 0; i < solution.size(); ++i) {
        out.variables[i].least = (out.variables[i].least - solution[i]) * magnification;
        out.variables[i].most = (out.variables[i].most - solution[i]) * magnification;
    }
    for (LinearProgram::Row& row : out.rows) {
        long double value = 0.0;
        for (std::size_t i = 0; i < solution.size(); ++i) {
            value += static_cast<long double>(row.factors[i]) * solution[i];
        }
        row.least = static_cast<double>((row.least - value) * magnification);
        row.most = static_cast<double>((row.most - value) * magnification);
    }
    return out;
}

} // namespace

std::optional<std::vector<double>> refined_optimum(const LinearProgram& program) {
    auto solution = optimum(program);
    for (int round = 0; solution && round < rounds; ++round) {
        const auto more = optimum(correction(program, *solution));
        if (!more) {
            break;
        }
        for (std::size_t i = 0; i < solution->size(); ++i) {
            (*solution)[i] += (*more)[i] / magnification;
        }
    }
    return solution;
}

} // namespace octant::visuals::separation
