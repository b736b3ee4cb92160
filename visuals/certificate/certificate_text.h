#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/proof_walk.h"
#include "visuals/separation/local_model.h"
#include "visuals/separation/separating_plane_proof.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace octant::visuals::certificate {

/// The lines of a certificate, in the order in which they are added; visuals/verify/README.md says
/// what each means.
class CertificateText : public draworder::ProofVisitor {
public:
    /// `size_m` is the length that is 1 in a LocalModel; `on_part_done` is called after each node and
    /// list.
    CertificateText(double size_m, std::function<void()> on_part_done);

    /// The header, corners, axes and polygons.
    void add_model(
        const models::polygons::PolygonModel& model,
        const separation::LocalModel& local,
        const models::polygons::FileAxes& axes);

    /// The lists and nodes. Where a choice has nothing on a side, its eyes are left unclaimed.
    void add_tree(
        const draworder::DrawOrder& order,
        const separation::LocalModel& local,
        const models::polygons::FileAxes& axes);

    void begin_pairs(int part, std::uint32_t later, std::size_t count) override;
    void add_pair(separation::DecidingPolygon by) override;
    void end_pairs() override;
    void add_plane_proof(
        int part,
        const separation::SeparatingPlaneProof& plane_proof,
        std::uint32_t earlier,
        std::uint32_t later) override;
    void add_back_facing(int part, std::uint32_t polygon, const separation::PlaneFactors& factors) override;
    void add_unproved(int part, std::uint32_t polygon) override;
    void end_part(std::size_t polygons) override;

    /// All lines so far, which are taken away.
    std::string take();

    /// Pairs and polygons for which no proof was found.
    std::uint64_t unproved() const { return unproved_; }

private:
    void add_run();
    void add_numbers(std::span<const std::uint32_t> numbers);
    void add_walls(const separation::PlaneFactors& factors);

    double size_m_;
    std::function<void()> on_part_done_;
    std::string text_;
    std::uint64_t unproved_ = 0;
    separation::DecidingPolygon run_by_ = separation::DecidingPolygon::Neither;
    std::size_t run_length_ = 0;
};

} // namespace octant::visuals::certificate
