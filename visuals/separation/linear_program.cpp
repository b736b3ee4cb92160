#include "visuals/separation/linear_program.h"

#include <ClpSimplex.hpp>
#include <algorithm>
#include <cassert>
#include <limits>
#include <vector>

namespace octant::visuals::separation {

namespace {

constexpr double tolerance = 1e-9;
constexpr int max_iterations = 10000;
constexpr int optimal = 0;
constexpr int no_perturbation = 100;
/// CLP's own scaling suits programmes of unequal factors. With factors of about 1 it ends in solutions that are no
/// optimum once they are scaled back.
constexpr int no_scaling = 0;
constexpr double maximise = -1.0;

/// A solver without a programme, as every one begins. CLP makes the words of all its messages for a new model, which
/// takes longer than a small programme; a copied model gets them in one piece.
ClpSimplex fresh_solver() {
    ClpSimplex solver;
    solver.setLogLevel(0);
    solver.setOptimizationDirection(maximise);
    solver.setPrimalTolerance(tolerance);
    solver.setDualTolerance(tolerance);
    solver.setMaximumIterations(max_iterations);
    solver.scaling(no_scaling);
    solver.setPerturbation(no_perturbation);
    return solver;
}

/// The bound as CLP takes it: the largest finite number and its negative stand for none.
double clp_bound(double bound) {
    constexpr double none = std::numeric_limits<double>::max();
    return std::clamp(bound, -none, none);
}

/// A linear programme as CLP reads it: the matrix by columns without its zeros, and all bounds.
struct Columns {
    std::vector<CoinBigIndex> starts{0};
    std::vector<int> rows;
    std::vector<double> factors;
    std::vector<double> weights;
    std::vector<double> least;
    std::vector<double> most;
    std::vector<double> row_min;
    std::vector<double> row_max;
};

Columns columns_of(const LinearProgram& program) {
    Columns columns;
    for (std::size_t i = 0; i < program.variables.size(); ++i) {
        const auto& [weight, least, most] = program.variables[i];
        columns.weights.push_back(weight);
        columns.least.push_back(clp_bound(least));
        columns.most.push_back(clp_bound(most));
        for (std::size_t row = 0; row < program.rows.size(); ++row) {
            assert(program.rows[row].factors.size() == program.variables.size());
            if (const double factor = program.rows[row].factors[i]; factor != 0.0) {
                columns.rows.push_back(static_cast<int>(row));
                columns.factors.push_back(factor);
            }
        }
        columns.starts.push_back(static_cast<CoinBigIndex>(columns.rows.size()));
    }
    for (const LinearProgram::Row& row : program.rows) {
        columns.row_min.push_back(clp_bound(row.least));
        columns.row_max.push_back(clp_bound(row.most));
    }
    return columns;
}

void load(ClpSimplex& solver, const Columns& columns) {
    solver.loadProblem(static_cast<int>(columns.weights.size()), static_cast<int>(columns.row_min.size()),
        columns.starts.data(), columns.rows.data(), columns.factors.data(), columns.least.data(), columns.most.data(),
        columns.weights.data(), columns.row_min.data(), columns.row_max.data());
}

} // namespace

// primal() works on its own model alone: unlike CLP's drivers it sets no signal handlers, and without perturbation it
// draws no random numbers. So threads may solve side by side, and the same programme always gives the same values.
std::optional<std::vector<double>> optimum(const LinearProgram& program) {
    static const ClpSimplex fresh = fresh_solver();
    ClpSimplex solver(fresh);
    load(solver, columns_of(program));
    solver.primal();
    if (solver.status() != optimal) { return std::nullopt; }
    const double* values = solver.getColSolution();
    return std::vector<double>(values, values + program.variables.size());
}

} // namespace octant::visuals::separation
