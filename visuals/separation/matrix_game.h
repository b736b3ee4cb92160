#pragma once

#include <cstddef>
#include <vector>

namespace octant::visuals::separation {

/// What each choice gives in each case, case after case.
struct Payoffs {
    std::size_t choices = 0;
    std::vector<double> values;

    std::size_t cases() const { return choices == 0 ? 0 : values.size() / choices; }
};

/// The shares of the choices, >= 0 with the sum 1, for which the worst case gives most (a game of
/// two against one another: J. von Neumann, "Zur Theorie der Gesellschaftsspiele", 1928). Meant for
/// up to some dozens of choices and cases with values of about 1; as exact as rounding allows. As
/// many shares as can be are 0. There is at least one of each (asserted). The same payoffs always
/// give the same shares.
std::vector<double> best_shares(const Payoffs& payoffs);

} // namespace octant::visuals::separation
