#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace octant::visuals::certificate {

/// What a certificate is bound to: the polygons of a model's file.
struct CertifiedModel {
    std::string name;
    std::string hash; ///< model_hash() of the polygons as they were read
};

/// A hash of the polygons of a model as read from its file, in the axes of the file: of the places of their corners and
/// of their turning axes, not of names and colours. 16 hexadecimal digits.
std::string model_hash(const models::polygons::PolygonModel& model, const models::polygons::FileAxes& axes);

/// An order that holds for every eye of a model (draworder::OrderMethod::Exact), or for those that a view split with
/// nothing on one side leaves (orderstudy::with_min_distance); of the others nothing is stated.
struct CertifiedOrder {
    const models::polygons::PolygonModel& model;
    const draworder::DrawOrder& order;
    const models::polygons::FileAxes& axes;
    const CertifiedModel& bound_to;
};

struct OrderCertificate {
    std::string text;           ///< visuals/verify/certificate-format.md describes it.
    std::uint64_t unproved = 0; ///< Pairs and polygons for which no proof was found.
};

/// Counts nodes and lists that are done, of all.
using CertificateProgress = std::function<void(std::size_t done, std::size_t all)>;

/// Writes down why an order is right for every eye: for each pair of polygons that it paints one before the other the
/// plane that proves that nothing is hidden wrongly, and for each polygon that it leaves out that it faces away. What
/// no proof is found for within a tolerance of 2e-9 of the model's size is sought with one of 1e-8 and then 5e-8, which
/// the text tells; what is left is marked as such and counted. The time grows with the pairs.
OrderCertificate order_certificate(const CertifiedOrder& proved, const CertificateProgress& progress = {});

struct WrittenCertificate {
    std::uint64_t bytes = 0;
    std::uint64_t unproved = 0;
    bool is_too_long = false; ///< it was given up and no file written
};

/// The same into a file, whole or not at all: no more of its statements than a few MiB are kept in memory at once. It
/// is given up where it would take more than `max_bytes`. Throws Error where the file cannot be written.
WrittenCertificate write_order_certificate(const std::filesystem::path& file, const CertifiedOrder& proved,
    std::uint64_t max_bytes, const CertificateProgress& progress = {});

} // namespace octant::visuals::certificate
