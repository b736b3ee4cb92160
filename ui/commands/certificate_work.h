#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "ui/base/figures_text.h"
#include "visuals/draworder/draw_order.h"

#include <string>

namespace octant::ui::commands {

/// Writes the certificate of an order that holds for every eye, and adds to the figures what it
/// leaves unproved.
void write_certificate(
    const std::string& file,
    const models::polygons::PolygonModel& model,
    const visuals::draworder::DrawOrder& order,
    const models::polygons::FileAxes& axes,
    bool quiet,
    base::Figures& figures);

/// Reads a certificate, checks it without rounding and adds to the figures; whether it proves all.
/// Throws Error for a file that is no certificate.
bool verified(const std::string& file, bool quiet, base::Figures& figures);

} // namespace octant::ui::commands
