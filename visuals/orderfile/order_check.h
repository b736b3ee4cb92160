#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "visuals/orderfile/cell_orders.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace octant::visuals::orderfile {

/// The planes, in their order, without those that the others imply.
std::vector<Plane> without_redundant(std::span<const Plane> planes);

/// Something that could not be proved.
struct UnprovedPair {
    std::size_t cell = 0;
    /// The polygon that is painted before `later` although it may hide part of it.
    std::uint32_t first = 0;
    /// The polygon painted later; the same as `first` for a polygon that is not listed although it may face an eye of
    /// the cell.
    std::uint32_t later = 0;
    bool operator==(const UnprovedPair&) const = default;
};

/// The result of check_order.
struct OrderCheck {
    long pairs = 0;                           ///< The pairs of polygons listed in one cell, over all cells.
    long by_plane = 0;                        ///< Of these, pairs separated by a plane of the cell or of the polygons.
    long by_linear_program = 0;               ///< Of these, pairs separated by a plane that a linear programme found.
    long pairs_unproved = 0;                  ///< Of these, pairs without a proof.
    long unlisted = 0;                        ///< The polygons that a cell does not list, over all cells.
    long unlisted_unproved = 0;               ///< Of these, polygons that may face an eye of the cell.
    std::vector<UnprovedPair> first_unproved; ///< The first open ones, cell by cell, at most max_doubts.
    static constexpr std::size_t max_doubts = 20;

    bool good() const { return pairs_unproved == 0 && unlisted_unproved == 0; }
};

/// Proves, without any of the code that finds orders, that an order is right for every eye of its cells: no polygon
/// hides part of one painted after it, and no polygon that is not listed faces an eye. Errors of less than 1e-6 of the
/// model's diagonal pass. Gaps between cells are found by rays (random_ray_test.h).
///
/// Polygons of turning parts are checked for all angles at once, by the rings that they sweep; those of one part are
/// checked against each other as rigid. This demands more than needed, and so does a cell whose least distance has no
/// plane (region_of): what stays open need not be wrong.
///
/// `progress(done, all)` is called after each cell. The time grows with the pairs: about 10,000 a second, more when
/// planes of the cell decide. `orders.faces` must equal the number of polygons (asserted).
OrderCheck check_order(const models::polygons::PolygonModel& model, const CellOrders& orders,
    const std::function<void(std::size_t, std::size_t)>& progress = {});

} // namespace octant::visuals::orderfile
