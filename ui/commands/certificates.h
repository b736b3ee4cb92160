#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "ui/base/results_text.h"
#include "visuals/draworder/draw_order.h"

#include <string>

namespace octant::ui::commands {

/// An order that holds for every eye, or for those that its choices leave
/// (visuals/draworder/with_min_distance.h), with the model that it speaks of.
struct CertifiedOrder {
    const models::polygons::PolygonModel& model;
    const visuals::draworder::DrawOrder& order;
    const models::polygons::FileAxes& axes;
};

/// Writes the certificate of an order, and adds to the figures what it leaves unproved.
void write_certificate(
    const std::string& file, const CertifiedOrder& proved, bool quiet, base::JsonValue& results);

/// Seeks the proofs of an order and checks them without rounding, without a file; adds to the
/// figures. False where something is not proved.
bool order_is_proved(const CertifiedOrder& proved, bool quiet, base::JsonValue& results);

/// Reads a certificate, checks it without rounding and adds to the figures; whether it proves all.
/// Throws Error for a file that is no certificate.
bool verify_certificate(const std::string& file, bool quiet, base::JsonValue& results);

} // namespace octant::ui::commands
