#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/proof_walk.h"
#include "visuals/separation/local_model.h"
#include "visuals/separation/witness.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace octant::visuals::certificate {

/// The lines of a certificate, in the order in which they are added; visuals/verify/README.md says
/// what each means.
class CertificateText : public draworder::ProofSink {
public:
    /// `size_m` is the length that is 1 in a LocalModel; `part_done` is called after each node and
    /// list.
    CertificateText(double size_m, std::function<void()> part_done);

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
    void add_pair(separation::Decider by) override;
    void end_pairs() override;
    void add_witness(
        int part,
        const separation::Witness& witness,
        std::uint32_t earlier,
        std::uint32_t later) override;
    void add_away(int part, std::uint32_t polygon, const separation::Factors& factors) override;
    void add_doubt(int part, std::uint32_t polygon) override;
    void end_part(std::size_t polygons) override;

    /// All lines so far, which are taken away.
    std::string take();

    /// Pairs and polygons for which no proof was found.
    std::uint64_t unproved() const { return unproved_; }

private:
    void add_run();
    void add_numbers(std::span<const std::uint32_t> numbers);
    void add_walls(const separation::Factors& factors);

    double size_m_;
    std::function<void()> part_done_;
    std::string text_;
    std::uint64_t unproved_ = 0;
    separation::Decider run_by_ = separation::Decider::Neither;
    std::size_t run_length_ = 0;
};

} // namespace octant::visuals::certificate
