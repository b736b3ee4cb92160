#pragma once

#include "ui/report/html_text.h"
#include "ui/studies/hybrid_shading/shading_control.h"
#include "ui/studies/hybrid_shading/shading_runs.h"

#include <span>

namespace octant::ui::studies::hybrid_shading {

/// Table 2 of the 2008 paper with the counts computed beside, its slip marked.
report::HtmlTable operation_table();

/// What the error rule gains over the paper's at few smooth polygons, in decibels.
report::HtmlTable gain_table(std::span<const ShadingRun> runs);

/// PSNR and SSIM of one model over the share of smooth polygons, all rules, both references.
report::HtmlTable quality_table(const ShadingRun& run);

/// How the share of smooth polygons followed made frame times.
report::HtmlTable control_table(std::span<const ControlRun> runs);

} // namespace octant::ui::studies::hybrid_shading
