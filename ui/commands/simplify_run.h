#pragma once

#include "models/simplify/paper_simplify.h"
#include "sim/base/thread_pool.h"
#include "ui/base/json_value.h"
#include "ui/base/output_options.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

/// Arguments of `octant simplify`.
struct SimplifyArguments : base::OutputOptions {
    std::vector<std::string> files; ///< as they stand in the command line
    std::string in;                 ///< the first one; with shared_border unused
    std::string out;                ///< the last one of two; empty without
    int vertices = 0;               ///< 0: no goal
    int faces = 0;                  ///< 0: no goal
    std::string error;
    std::string method;          ///< Empty: as --method surface
    int effort = -1;             ///< That of the method
    int steps = -1;              ///< Those of the effort
    double max_seconds = 0.0;    ///< 0: no limit
    double colour_weight = -1.0; ///< That of the method
    int threads = core_count();
    bool chain = false;
    bool keep_seams_apart = false;
    bool keep_shells = false;
    bool keep_topology = false;
    bool lock_border = false;
    bool shared_border = false;
    std::string out_dir;
    double uv_error = 0.0;     ///< 0: no bound
    double normal_error = 0.0; ///< degrees; 0: no bound
    double colour_error = 0.0; ///< 0: no bound
    std::string chart;
    std::string polygons;
};

/// Whether an attribute has a bound.
bool has_attribute_bound(const SimplifyArguments& command);

/// A largest error of `octant simplify` from text: "0.5" in the file's units or "0.1%" of the diagonal. Throws Error
/// for anything else.
double error_m_from(const std::string& text, double diagonal_m);

/// The paper's measure where the method is one of the paper's.
std::optional<models::simplify::PaperMeasure> paper_measure(const std::string& method);

/// Simplifies one mesh in the way that the command says: to a file, to levels of detail, as a chart or as printed.
/// Writes the files and adds to the figures. Returns whether the goal was reached. Throws Error.
bool simplify_one(const SimplifyArguments& command, base::JsonValue& results);

/// Simplifies several meshes as one, so that their common borders stay common, and writes each to the folder, all or
/// none. Returns whether all goals were reached. Throws Error.
bool simplify_with_shared_borders(const SimplifyArguments& command, base::JsonValue& results);

} // namespace octant::ui::commands
