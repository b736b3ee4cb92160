// From parts to cells: the walk of an eye through the tree is done for all eyes of a region at
// once, and divides where they would go different ways.
#include "visuals/orderfile/cells_of_parts.h"

#include "sim/base/plane.h"
#include "visuals/draworder/eye_region.h"
#include "visuals/draworder/model_faces.h"

#include <cstdint>
#include <utility>

namespace octant::visuals::orderfile {

namespace {

using draworder::DrawOrder;
using draworder::EyeRegion;

/// The eyes of a region on their way through the tree.
struct Wanderers {
    EyeRegion region;
    std::size_t cuts = 0;
    std::vector<int> to_do;
    std::vector<std::uint32_t> list;
};

class Expanding {
public:
    Expanding(const models::polygons::PolygonModel& model, const DrawOrder& order)
        : order_(order)
        , frame_(empty_frame(model)) {}

    std::optional<std::vector<CellOfParts>> cells() {
        groups_.push_back({EyeRegion::everywhere(), 0, {order_.nodes().empty() ? ~0 : 0}, {}});
        while (!groups_.empty()) {
            Wanderers group = std::move(groups_.back());
            groups_.pop_back();
            if (!walk(std::move(group))) {
                return std::nullopt;
            }
        }
        return std::move(cells_);
    }

private:
    /// The unit and origin of faces, without faces.
    static draworder::ModelFaces empty_frame(const models::polygons::PolygonModel& model) {
        draworder::ModelFaces frame{
            .faces = {},
            .tolerances = {},
            .rigid = draworder::HidingGraph(0),
            .ignored = draworder::HidingGraph(0),
            .notes = {}};
        const double radius_m = models::polygons::radius_m(model);
        frame.unit_m = radius_m > 0.0 ? radius_m : 1.0;
        return frame;
    }

    /// Goes on until the eyes part or have painted everything; false when there are too many cells.
    bool walk(Wanderers group) {
        while (!group.to_do.empty()) {
            const int at = group.to_do.back();
            group.to_do.pop_back();
            if (at == DrawOrder::nothing) {
                continue;
            }
            if (at < 0) {
                const auto list = order_.polygons_of(~at);
                group.list.insert(group.list.end(), list.begin(), list.end());
                continue;
            }
            const DrawOrder::Node& node = order_.nodes()[static_cast<std::size_t>(at)];
            if (node.kind == DrawOrder::Kind::Sequence) {
                group.to_do.insert(group.to_do.end(), {node.back, node.front});
                continue;
            }
            if (!cross(group, node)) {
                return false;
            }
        }
        return finish(std::move(group));
    }

    /// Lets the eyes go on beyond a plane, those behind it in a group of their own.
    bool cross(Wanderers& group, const DrawOrder::Node& node) {
        const Plane plane = frame_.in_faces(node.plane);
        const Plane turned = turned_over(plane);
        const bool some_before = group.region.reaches_front_of(plane);
        const bool some_behind = group.region.reaches_front_of(turned);
        if (some_before && some_behind) {
            if (group.cuts == EyeRegion::max_planes || groups_.size() > max_cells_of_parts) {
                return false;
            }
            Wanderers behind{*group.region.cut(turned), group.cuts + 1, group.to_do, group.list};
            go(behind, node, false);
            groups_.push_back(std::move(behind));
            group.region = *group.region.cut(plane);
            ++group.cuts;
        }
        go(group, node, some_before);
        return true;
    }

    static void go(Wanderers& group, const DrawOrder::Node& node, bool in_front) {
        group.to_do.push_back(in_front ? node.front : node.back);
        if (node.kind == DrawOrder::Kind::Parting) {
            group.to_do.push_back(in_front ? node.along : node.against);
            group.to_do.push_back(in_front ? node.back : node.front);
        }
    }

    bool finish(Wanderers group) {
        entries_ += group.list.size();
        if (cells_.size() == max_cells_of_parts || entries_ > max_entries_of_parts) {
            return false;
        }
        CellOfParts& cell = cells_.emplace_back();
        for (const Plane& plane : group.region.planes()) {
            cell.planes.push_back(frame_.in_model(plane));
        }
        cell.list = std::move(group.list);
        return true;
    }

    const DrawOrder& order_;
    draworder::ModelFaces frame_;
    std::vector<Wanderers> groups_;
    std::vector<CellOfParts> cells_;
    std::size_t entries_ = 0;
};

} // namespace

std::optional<std::vector<CellOfParts>>
cells_of_parts(const models::polygons::PolygonModel& model, const DrawOrder& order) {
    return Expanding(model, order).cells();
}

} // namespace octant::visuals::orderfile
