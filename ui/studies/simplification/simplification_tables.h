#pragma once

#include "ui/report/html_text.h"
#include "ui/studies/simplification/simplification_runs.h"

#include <span>
#include <string>

namespace octant::ui::studies::simplification {

/// How the paper was read, above its tables: Markdown.
std::string paper_reading_text();

/// Table 1: how many perpendiculars end outside their triangle.
report::HtmlTable feet_table(std::span<const PaperRun> runs);

/// Table 2: sums of errors, and what an independent measure says of the results.
report::HtmlTable paper_error_table(std::span<const PaperRun> runs);

/// Every method on every mesh: distance to the original and time.
report::HtmlTable quality_table(std::span<const QualityRun> runs, bool with_peers);

/// RMS distance over faces, a panel a mesh, as the bytes of a PNG file; empty for one number of
/// faces and when gnuplot is not installed. Throws Error when gnuplot fails.
std::string quality_figure(std::span<const QualityRun> runs);

} // namespace octant::ui::studies::simplification
