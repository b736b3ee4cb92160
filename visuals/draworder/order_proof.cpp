#include "visuals/draworder/order_proof.h"

#include "visuals/draworder/proof_walk.h"
#include "visuals/draworder/search_budget.h"

#include <cstddef>
#include <cstdint>

namespace octant::visuals::draworder {

namespace {

/// About the work of one of each (SearchBudget).
constexpr std::uint64_t units_of_pair = 20;
constexpr std::uint64_t units_of_witness = 2'000;
constexpr std::uint64_t units_of_none = 1'000'000;
constexpr std::uint64_t units_of_polygon_in_part = 60;

/// Counts what is found, and what that costs.
class Counting : public ProofVisitor {
public:
    explicit Counting(SearchBudget& budget)
        : budget_(budget) {}

    OrderProof& proof() { return proof_; }

    void begin_pairs(int /*part*/, std::uint32_t /*later*/, std::size_t count) override {
        budget_.spend(units_of_pair * count);
    }

    void add_pair(separation::DecidingPolygon /*by*/) override {}

    void end_pairs() override {}

    void add_plane_proof(
        int /*part*/,
        const separation::SeparatingPlaneProof& plane_proof,
        std::uint32_t earlier,
        std::uint32_t later) override {
        if (plane_proof.kind != separation::SeparatingPlaneProof::Kind::None) {
            budget_.spend(units_of_witness);
            return;
        }
        ++proof_.unproved;
        if (proof_.unproved_pairs.size() < OrderProof::max_open) {
            proof_.unproved_pairs.emplace_back(earlier, later);
        }
        budget_.spend(units_of_none);
    }

    void add_back_facing(
        int /*part*/, std::uint32_t /*polygon*/, const separation::PlaneFactors& /*factors*/) override {
        budget_.spend(units_of_witness);
    }

    void add_unproved(int /*part*/, std::uint32_t /*polygon*/) override {
        ++proof_.unproved;
        budget_.spend(units_of_none);
    }

    void end_part(std::size_t polygons) override {
        budget_.spend(units_of_polygon_in_part * polygons);
    }

private:
    SearchBudget& budget_;
    OrderProof proof_;
};

} // namespace

OrderProof
prove_order(const models::polygons::PolygonModel& model, const DrawOrder& order, double seconds) {
    SearchBudget budget(seconds);
    OrderProof best;
    if (model.corner_vertices.empty()) {
        best.is_complete = true;
        return best;
    }
    const models::polygons::FileAxes axes;
    for (const double tolerance : separation::proof_tolerances_sizes) {
        const separation::LocalModel local = separation::local_model(model, axes, tolerance);
        Counting counting(budget);
        try {
            visit_proof({model, order, axes, local}, counting);
            counting.proof().is_complete = true;
        } catch (const SearchGivenUp&) {
            return best.is_complete ? best : counting.proof();
        }
        if (!best.is_complete || counting.proof().unproved < best.unproved) {
            best = counting.proof();
        }
        if (best.unproved == 0) {
            break;
        }
    }
    return best;
}

} // namespace octant::visuals::draworder
