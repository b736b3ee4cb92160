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
class Counting : public ProofSink {
public:
    explicit Counting(SearchBudget& budget)
        : budget_(budget) {}

    OrderProof& proof() { return proof_; }

    void begin_pairs(int /*part*/, std::uint32_t /*later*/, std::size_t count) override {
        budget_.spend(units_of_pair * count);
    }

    void add_pair(separation::Decider /*by*/) override {}

    void end_pairs() override {}

    void add_witness(
        int /*part*/,
        const separation::Witness& witness,
        std::uint32_t earlier,
        std::uint32_t later) override {
        if (witness.kind != separation::Witness::Kind::None) {
            budget_.spend(units_of_witness);
            return;
        }
        ++proof_.unproved;
        if (proof_.open.size() < OrderProof::max_open) {
            proof_.open.emplace_back(earlier, later);
        }
        budget_.spend(units_of_none);
    }

    void add_away(
        int /*part*/, std::uint32_t /*polygon*/, const separation::Factors& /*factors*/) override {
        budget_.spend(units_of_witness);
    }

    void add_doubt(int /*part*/, std::uint32_t /*polygon*/) override {
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
order_proof(const models::polygons::PolygonModel& model, const DrawOrder& order, double seconds) {
    SearchBudget budget(seconds);
    OrderProof best;
    if (model.corner_vertices.empty()) {
        best.is_whole = true;
        return best;
    }
    const models::polygons::FileAxes axes;
    for (const double tolerance : separation::proof_tolerances_sizes) {
        const separation::LocalModel local = separation::local_model(model, axes, tolerance);
        Counting counting(budget);
        try {
            walk_proof({model, order, axes, local}, counting);
            counting.proof().is_whole = true;
        } catch (const SearchGivenUp&) {
            return best.is_whole ? best : counting.proof();
        }
        if (!best.is_whole || counting.proof().unproved < best.unproved) {
            best = counting.proof();
        }
        if (best.unproved == 0) {
            break;
        }
    }
    return best;
}

} // namespace octant::visuals::draworder
