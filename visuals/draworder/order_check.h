#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/cell_orders.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace octant::visuals::draworder {

/// Something that could not be shown.
struct Doubt {
    std::size_t cell = 0;
    std::uint32_t first = 0; ///< painted before `later` although it may hide part of it
    std::uint32_t later = 0; ///< = first: not listed although it may face an eye of the cell
    bool operator==(const Doubt&) const = default;
};

/// What a certificate says of an order.
struct OrderCheck {
    long pairs = 0;            ///< of polygons listed in one cell, over all cells
    long by_plane = 0;         ///< of these, parted by a plane of the cell or of the polygons
    long by_programme = 0;     ///< parted by a plane that a linear programme found
    long pairs_open = 0;       ///< neither
    long unlisted = 0;         ///< polygons that a cell does not list, over all cells
    long unlisted_open = 0;    ///< of these, those that may face an eye of the cell
    std::vector<Doubt> doubts; ///< the first of the open ones, cell by cell, at most most_doubts
    static constexpr std::size_t most_doubts = 20;

    bool good() const { return pairs_open == 0 && unlisted_open == 0; }
};

/// Shows, without any of the code that finds orders, that an order is right for every eye of its
/// cells: that no polygon hides part of one painted after it, and that no polygon which is not
/// listed faces an eye. What lies wrong by less than 1e-6 of the model's diagonal passes. Whether
/// the cells leave gaps is a question for rays (ray_check.h).
///
/// Polygons of turning parts are checked for all angles at once, within the rings that they sweep,
/// those of one part against each other as rigid. This asks more than needed, as does a region that
/// knows no plane for its least distance (region_of): what stays open need not be wrong.
///
/// `progress(done, all)` is called after each cell. Time grows with the pairs: about 10,000 a
/// second, more when planes of the cell decide.
OrderCheck certify(
    const models::polygons::PolygonModel& model,
    const CellOrders& orders,
    const std::function<void(std::size_t, std::size_t)>& progress = {});

} // namespace octant::visuals::draworder
