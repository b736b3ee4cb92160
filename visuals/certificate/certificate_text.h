#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "visuals/certificate/local_model.h"
#include "visuals/certificate/witness.h"
#include "visuals/draworder/draw_order.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace octant::visuals::certificate {

/// The lines of a certificate, in the order in which they are added; visuals/verify/README.md says
/// what each means. A part is a child of a node as draworder::DrawOrder numbers them.
class CertificateText {
public:
    /// `size_m` is the length that is 1 in a LocalModel.
    explicit CertificateText(double size_m);

    /// The header, corners, axes and polygons.
    void add_model(
        const models::polygons::PolygonModel& model,
        const LocalModel& local,
        const models::polygons::FileAxes& axes);

    /// The lists and nodes. Where a choice has nothing on a side, its eyes are left unclaimed.
    void add_tree(const draworder::DrawOrder& order, const models::polygons::FileAxes& axes);

    /// The pairs of one later polygon with the earlier ones of a part: begin, one call a pair in
    /// the order of the part, end.
    void begin_pairs(int part, std::uint32_t later);
    void add_pair(Decider by);
    void end_pairs();

    void add_witness(int part, const Witness& witness, std::uint32_t earlier, std::uint32_t later);

    /// The polygon faces away from every eye that comes to the part.
    void add_away(int part, std::uint32_t polygon, const Factors& factors);

    /// No proof is found for the polygon.
    void add_doubt(int part, std::uint32_t polygon);

    /// All lines so far, which are taken away.
    std::string take();

    /// Pairs and polygons for which no proof was found.
    std::uint64_t unproved() const { return unproved_; }

private:
    void add_run();
    void add_numbers(std::span<const std::uint32_t> numbers);
    void add_walls(const Factors& factors);

    double size_m_;
    std::string text_;
    std::uint64_t unproved_ = 0;
    Decider run_by_ = Decider::Neither;
    std::size_t run_length_ = 0;
};

} // namespace octant::visuals::certificate
