#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace octant::visuals::separation {

/// The bound of a variable or row that has none on that side.
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A linear programme: find the variables that make the sum of weight * variable largest while all bounds hold. Meant
/// for tens of variables and a few hundred rows with factors of about 1.
struct LinearProgram {
    struct Variable {
        double weight = 0.0;
        double least = 0.0;
        double most = unbounded;
    };

    /// A constraint: least <= sum of factors[i] * variable i <= most, with one factor for each variable (asserted).
    struct Row {
        std::vector<double> factors;
        double least = -unbounded;
        double most = unbounded;
    };

    std::vector<Variable> variables;
    std::vector<Row> rows;
};

/// The variables of an optimum, bounds kept within 1e-9; nothing when there is no optimum or none was found. By the
/// primal simplex method (CLP). Threads may call it side by side.
std::optional<std::vector<double>> optimum(const LinearProgram& program);

} // namespace octant::visuals::separation
