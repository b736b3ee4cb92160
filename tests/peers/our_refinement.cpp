#include "visuals/refine/selective_refiner.h"

#include "refine_peers.h"

namespace octant::tests::peers {

namespace {

namespace refine = visuals::refine;

class OurRefinement : public PeerRefinement {
public:
    OurRefinement(const Hierarchy& mesh, SplitOrder order, bool together)
        : front_(mesh, {.repair = false}), nodes_(split_order(*mesh, order)), together_(together) {}

    void restart() override { front_.restart(); }

    void split_all() override {
        if (together_) {
            front_.split_all(nodes_);
            return;
        }
        for (const std::uint32_t node : nodes_) { front_.split(node); }
    }

    FaceSet faces() const override {
        FaceSet faces;
        const auto indices = front_.indices();
        for (std::size_t at = 0; at < indices.size(); at += 3) {
            if (front_.face_at(at / 3) != refine::none) {
                faces.push_back(
                    {front_.node_at(indices[at]), front_.node_at(indices[at + 1]), front_.node_at(indices[at + 2])});
            }
        }
        sort_faces(faces);
        return faces;
    }

    const refine::SelectiveRefiner& front() const { return front_; }

private:
    refine::SelectiveRefiner front_;
    std::vector<std::uint32_t> nodes_;
    bool together_;
};

} // namespace

std::unique_ptr<PeerRefinement> our_refinement(const Hierarchy& mesh, SplitOrder order, bool together) {
    auto made = std::make_unique<OurRefinement>(mesh, order, together);
    made->split_all();
    made->name = order == SplitOrder::BySubtree ? "octant, by subtree" : "octant, coarse first";
    made->name += together ? ", one call" : "";
    made->heap_bytes = static_cast<double>(
        mesh->bytes() + made->front().bytes() + made->front().vertices().size() * sizeof(refine::RefinedVertex));
    return made;
}

} // namespace octant::tests::peers
