#pragma once

#include "ui/commands/option.h"
#include "visuals/draworder/ordered_model.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

inline constexpr int default_rays = 200000; ///< of a check

struct DrawOrderOptions {
    std::string model;
    std::string axes = "right,up,back";
    visuals::draworder::OrderOptions order;
    std::optional<std::string> cache; ///< folder of kept orders
    bool table = false;
    std::string export_file;
    std::string export_model;
    std::string certificate; ///< the file to which the proof is written
    std::string verify;      ///< a proof to check; then nothing else is done
    bool check = false;
    std::string check_file;  ///< the order to check; empty: the one that was computed
    std::optional<int> rays; ///< how many the order is tried by; 0: no trial
    bool json = false;
    bool quiet = false;
};

void add_draw_order_options(std::vector<Option>& table, DrawOrderOptions& options);

/// Throws Error for options that do not go together, and where one file would be written over
/// another or over the model.
void check_draw_order_options(const DrawOrderOptions& options);

} // namespace octant::ui::commands
