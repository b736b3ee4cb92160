#include "visuals/draworder/linear_programme.h"

#include <cassert>
#include <cmath>
#include <glpk.h>
#include <memory>

namespace octant::visuals::draworder {

namespace {

constexpr double tolerance = 1e-9;
constexpr int most_iterations = 10000;

int kind_of(double least, double most) {
    if (std::isfinite(least) && std::isfinite(most)) {
        return least == most ? GLP_FX : GLP_DB;
    }
    if (std::isfinite(least)) {
        return GLP_LO;
    }
    return std::isfinite(most) ? GLP_UP : GLP_FR;
}

using Problem = std::unique_ptr<glp_prob, decltype(&glp_delete_prob)>;

void add_variables(glp_prob* problem, const LinearProgramme& programme) {
    glp_add_cols(problem, static_cast<int>(programme.variables.size()));
    for (std::size_t i = 0; i < programme.variables.size(); ++i) {
        const auto& [weight, least, most] = programme.variables[i];
        const int column = static_cast<int>(i) + 1;
        glp_set_obj_coef(problem, column, weight);
        glp_set_col_bnds(problem, column, kind_of(least, most), least, most);
    }
}

void add_rows(glp_prob* problem, const LinearProgramme& programme) {
    std::vector<int> columns{0}; // GLPK counts from 1
    for (std::size_t i = 1; i <= programme.variables.size(); ++i) {
        columns.push_back(static_cast<int>(i));
    }
    std::vector<double> factors;
    glp_add_rows(problem, static_cast<int>(programme.rows.size()));
    for (std::size_t i = 0; i < programme.rows.size(); ++i) {
        const auto& row = programme.rows[i];
        assert(row.factors.size() == programme.variables.size());
        factors.assign(1, 0.0);
        factors.insert(factors.end(), row.factors.begin(), row.factors.end());
        const int number = static_cast<int>(i) + 1;
        glp_set_row_bnds(problem, number, kind_of(row.least, row.most), row.least, row.most);
        glp_set_mat_row(
            problem, number, static_cast<int>(row.factors.size()), columns.data(), factors.data());
    }
}

} // namespace

std::optional<std::vector<double>> optimum(const LinearProgramme& programme) {
    glp_term_out(GLP_OFF);
    const Problem problem(glp_create_prob(), &glp_delete_prob);
    glp_set_obj_dir(problem.get(), GLP_MAX);
    add_variables(problem.get(), programme);
    if (!programme.rows.empty()) { // none at all is an error to GLPK
        add_rows(problem.get(), programme);
    }
    glp_smcp settings{};
    glp_init_smcp(&settings);
    settings.msg_lev = GLP_MSG_OFF;
    settings.tol_bnd = tolerance;
    settings.tol_dj = tolerance;
    settings.it_lim = most_iterations;
    if (glp_simplex(problem.get(), &settings) != 0 || glp_get_status(problem.get()) != GLP_OPT) {
        return std::nullopt;
    }
    std::vector<double> values;
    for (std::size_t i = 1; i <= programme.variables.size(); ++i) {
        values.push_back(glp_get_col_prim(problem.get(), static_cast<int>(i)));
    }
    return values;
}

} // namespace octant::visuals::draworder
