#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/separation/separating_plane_proof.h"

#include <cstddef>
#include <cstdint>

namespace octant::visuals::draworder {

/// Receives the reasons why an order is right. A part is a child of a node, numbered as by DrawOrder.
class ProofVisitor {
public:
    virtual ~ProofVisitor() = default;

    /// The pairs of one later polygon with `count` earlier ones of a part, which their own planes may decide: begin,
    /// one call a pair in the order of the part, end.
    virtual void begin_pairs(int part, std::uint32_t later, std::size_t count) = 0;
    virtual void add_pair(separation::DecidingPolygon by) = 0;
    virtual void end_pairs() = 0;

    /// The proof for a pair that no own plane decides, or Kind::None.
    virtual void add_plane_proof(
        int part, const separation::SeparatingPlaneProof& plane_proof, std::uint32_t earlier, std::uint32_t later) = 0;

    /// The polygon faces away from every eye that comes to the part.
    virtual void add_back_facing(int part, std::uint32_t polygon, const separation::PlaneFactors& factors) = 0;

    /// No proof is found for the polygon.
    virtual void add_unproved(int part, std::uint32_t polygon) = 0;

    /// A node or list, with so many polygons, is done.
    virtual void end_part(std::size_t polygons) = 0;
};

/// An order, and the model as proofs are sought for it.
struct ProofInput {
    const models::polygons::PolygonModel& model;
    const DrawOrder& order;
    const models::polygons::FileAxes& axes;
    const separation::LocalModel& local; ///< Of the same model and axes.
};

/// Walks through an order and seeks for each pair of polygons that it paints one before the other the plane that proves
/// that nothing is hidden wrongly, and for each polygon that it leaves out that it faces away. The order is one for
/// every eye of the model, or for those that a view split with nothing on one side leaves. An
/// exception of the visitor ends the walk.
void visit_proof(const ProofInput& input, ProofVisitor& visitor);

} // namespace octant::visuals::draworder
