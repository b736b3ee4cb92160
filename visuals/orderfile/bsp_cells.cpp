// From parts to cells: the walk of an eye through the tree is done for all eyes of a region at
// once, and divides where they would go different ways.
#include "visuals/orderfile/bsp_cells.h"

#include "sim/base/plane.h"
#include "visuals/draworder/view_region.h"
#include "visuals/draworder/model_faces.h"

#include <cstdint>
#include <utility>

namespace octant::visuals::orderfile {

namespace {

using draworder::DrawOrder;
using draworder::ViewRegion;

/// The eyes of a region on their way through the tree.
struct MovingPolygons {
    ViewRegion region;
    std::size_t cuts = 0;
    std::vector<int> pending;
    std::vector<std::uint32_t> list;
};

class CellExpander {
public:
    CellExpander(const models::polygons::PolygonModel& model, const DrawOrder& order)
        : order_(order)
        , frame_(empty_frame(model)) {}

    std::optional<std::vector<BspCell>> cells() {
        groups_.push_back({ViewRegion::all_space(), 0, {order_.nodes().empty() ? ~0 : 0}, {}});
        while (!groups_.empty()) {
            MovingPolygons group = std::move(groups_.back());
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
            .rigid = draworder::OcclusionGraph(0),
            .ignored = draworder::OcclusionGraph(0),
            .notes = {}};
        const double radius_m = models::polygons::radius_m(model);
        frame.unit_m = radius_m > 0.0 ? radius_m : 1.0;
        return frame;
    }

    /// Goes on until the eyes part or have painted everything; false when there are too many cells.
    bool walk(MovingPolygons group) {
        while (!group.pending.empty()) {
            const int at = group.pending.back();
            group.pending.pop_back();
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
                group.pending.insert(group.pending.end(), {node.back, node.front});
                continue;
            }
            if (!cross(group, node)) {
                return false;
            }
        }
        return finish(std::move(group));
    }

    /// Lets the eyes go on beyond a plane, those behind it in a group of their own.
    bool cross(MovingPolygons& group, const DrawOrder::Node& node) {
        const Plane plane = frame_.to_face_space(node.plane);
        const Plane turned = turned_over(plane);
        const bool some_before = group.region.intersects_front_of(plane);
        const bool some_behind = group.region.intersects_front_of(turned);
        if (some_before && some_behind) {
            if (group.cuts == ViewRegion::max_planes || groups_.size() > max_cells_of_parts) {
                return false;
            }
            MovingPolygons behind{*group.region.cut(turned), group.cuts + 1, group.pending, group.list};
            go(behind, node, false);
            groups_.push_back(std::move(behind));
            group.region = *group.region.cut(plane);
            ++group.cuts;
        }
        go(group, node, some_before);
        return true;
    }

    static void go(MovingPolygons& group, const DrawOrder::Node& node, bool in_front) {
        group.pending.push_back(in_front ? node.front : node.back);
        if (node.kind == DrawOrder::Kind::PolygonSplit) {
            group.pending.push_back(in_front ? node.coplanar_front : node.coplanar_back);
            group.pending.push_back(in_front ? node.back : node.front);
        }
    }

    bool finish(MovingPolygons group) {
        entries_ += group.list.size();
        if (cells_.size() == max_cells_of_parts || entries_ > max_entries_of_parts) {
            return false;
        }
        BspCell& cell = cells_.emplace_back();
        for (const Plane& plane : group.region.planes()) {
            cell.planes.push_back(frame_.in_model(plane));
        }
        cell.list = std::move(group.list);
        return true;
    }

    const DrawOrder& order_;
    draworder::ModelFaces frame_;
    std::vector<MovingPolygons> groups_;
    std::vector<BspCell> cells_;
    std::size_t entries_ = 0;
};

} // namespace

std::optional<std::vector<BspCell>>
bsp_cells(const models::polygons::PolygonModel& model, const DrawOrder& order) {
    return CellExpander(model, order).cells();
}

} // namespace octant::visuals::orderfile
