// A certificate for painting orders, the exact rule turned round: the code that finds orders looks for what hides what,
// and this code looks for planes which prove that nothing does. It shares no code with the search, so that a mistake
// there cannot repeat itself here.
#include "visuals/orderfile/order_check.h"

#include "visuals/separation/check_shape.h"
#include "visuals/separation/separation.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

namespace octant::visuals::orderfile {

namespace {

/// The sine of the angle below which a plane stays where it is when it turns about an axis.
constexpr double along_axis = 1e-9;

using Planes = std::vector<Plane>;

/// One run of check_order.
class OrderChecker {
public:
    OrderChecker(const models::polygons::PolygonModel& model, const CellOrders& orders)
        : model_(model), orders_(orders), frame_(separation::check_frame(model)),
          shapes_(separation::check_shapes(model, frame_, orders.two_sided)) {}

    OrderCheck check(const std::function<void(std::size_t, std::size_t)>& progress) {
        for (std::size_t i = 0; i < orders_.cells.size(); ++i) {
            check_cell(i);
            if (progress) { progress(i + 1, orders_.cells.size()); }
        }
        return std::move(check_);
    }

private:
    void check_cell(std::size_t cell) {
        const auto& list = orders_.cells[cell].list;
        region_.clear();
        for (const Plane& plane : region_of(orders_, orders_.cells[cell])) {
            region_.push_back(frame_.from_body(plane));
        }
        std::vector<bool> listed(shapes_.size());
        for (const std::uint32_t polygon : list) { listed[polygon] = true; }
        for (std::uint32_t polygon = 0; polygon < shapes_.size(); ++polygon) {
            if (!listed[polygon]) { check_unlisted(cell, polygon); }
        }
        for (std::size_t first = 0; first < list.size(); ++first) {
            for (std::size_t later = first + 1; later < list.size(); ++later) {
                check_pair(cell, list[first], list[later]);
            }
        }
    }

    /// Checks that a polygon which a cell does not list faces away from all its eyes.
    void check_unlisted(std::size_t cell, std::uint32_t polygon) {
        ++check_.unlisted;
        const auto& fronts = shapes_[polygon].swept_fronts;
        const bool unseen =
            std::ranges::all_of(fronts, [&](const Plane& front) { return separation::is_behind(region_, front); });
        if (!unseen) {
            ++check_.unlisted_unproved;
            doubt({cell, polygon, polygon});
        }
    }

    /// Checks that a polygon hides nothing of one that is painted later.
    void check_pair(std::size_t cell, std::uint32_t first, std::uint32_t later) {
        ++check_.pairs;
        switch (certificate(shapes_[first], shapes_[later])) {
        case separation::SeparationMethod::Plane:
            ++check_.by_plane;
            break;
        case separation::SeparationMethod::LinearProgram:
            ++check_.by_linear_program;
            break;
        case separation::SeparationMethod::None:
            ++check_.pairs_unproved;
            doubt({cell, first, later});
        }
    }

    /// The weakest certificate over the sides from which each of the two polygons is seen.
    separation::SeparationMethod certificate(
        const separation::CheckShape& occluder, const separation::CheckShape& far_one) const {
        const bool rigid = occluder.pivot == far_one.pivot;
        const Planes region = rigid && occluder.pivot ? unturned(*occluder.pivot) : region_;
        separation::SeparationMethod weakest = separation::SeparationMethod::Plane;
        for (const Planes& near_side : sides_of(occluder, rigid)) {
            for (const Planes& far_side : sides_of(far_one, rigid)) {
                Planes planes = region;
                planes.insert(planes.end(), near_side.begin(), near_side.end());
                planes.insert(planes.end(), far_side.begin(), far_side.end());
                weakest = std::max(weakest, separation::find_separation(rigid ? occluder.corners : occluder.swept,
                                                rigid ? far_one.corners : far_one.swept, planes));
            }
        }
        return weakest;
    }

    /// For each side from which a polygon is seen, the planes that those eyes are in front of.
    static std::vector<Planes> sides_of(const separation::CheckShape& shape, bool rigid) {
        if (!rigid && shape.swept_fronts.size() != shape.fronts.size()) { return {Planes{}}; }
        std::vector<Planes> sides;
        for (const Plane& front : shape.fronts) { sides.push_back({front}); }
        return sides;
    }

    /// The region as a turning part sees it: only planes perpendicular to its axis hold at every angle.
    Planes unturned(std::uint32_t pivot) const {
        Planes planes;
        std::ranges::copy_if(region_, std::back_inserter(planes), [&](const Plane& plane) {
            return glm::length(glm::cross(plane.normal, model_.pivots[pivot].axis)) < along_axis;
        });
        return planes;
    }

    void doubt(const UnprovedPair& doubt) {
        if (check_.first_unproved.size() < OrderCheck::max_doubts) { check_.first_unproved.push_back(doubt); }
    }

    const models::polygons::PolygonModel& model_;
    const CellOrders& orders_;
    separation::CheckFrame frame_;
    std::vector<separation::CheckShape> shapes_;
    Planes region_; ///< The region of the cell that is being checked.
    OrderCheck check_;
};

} // namespace

OrderCheck check_order(const models::polygons::PolygonModel& model, const CellOrders& orders,
    const std::function<void(std::size_t, std::size_t)>& progress) {
    assert(orders.faces == model.polygons.size());
    return OrderChecker(model, orders).check(progress);
}

} // namespace octant::visuals::orderfile
