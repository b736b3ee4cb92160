// OpenMesh's view-dependent progressive meshes: its hierarchy (VHierarchy), front (VFront) and mesh (vertex_split) are
// in its library; the step that finds the active cut vertices and applies a split is in its viewer application only,
// and is done here the way that application does it: cut vertices by a walk around the vertex with
// VHierarchy::is_ancestor, forced splits while both are one.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/VDPM/MeshTraits.hh>
#include <OpenMesh/Tools/VDPM/VFront.hh>
#include <OpenMesh/Tools/VDPM/VHierarchy.hh>
#include <stdexcept>

#include "refine_peers.h"

namespace octant::tests::peers {

namespace {

using visuals::refine::none;
using Mesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::VDPM::MeshTraits>;
using Node = OpenMesh::VDPM::VHierarchyNodeHandle;
using NodeIndex = OpenMesh::VDPM::VHierarchyNodeIndex;
using Vertex = OpenMesh::VertexHandle;

OpenMesh::Vec3f vec(const glm::vec3& v) { return {v.x, v.y, v.z}; }

class OpenMeshRefinement : public PeerRefinement {
public:
    OpenMeshRefinement(const Hierarchy& hierarchy, SplitOrder order)
        : source_(*hierarchy), order_(split_order(*hierarchy, order)), handles_(source_.node_count()),
          vertices_(source_.node_count(), none) {
        const double before = heap_bytes_now();
        number_vertices();
        make_nodes();
        make_base();
        mesh_ = base_;
        mesh_.reserve(source_.leaf_count(), source_.leaf_count() + source_.face_count() + 1000, source_.face_count());
        restart();
        split_all();
        heap_bytes = heap_bytes_now() - before - base_bytes_;
    }

    void restart() override {
        mesh_.assign_connectivity(base_);
        for (const Vertex vertex : base_.vertices()) {
            mesh_.set_point(vertex, base_.point(vertex));
            mesh_.data(vertex) = base_.data(vertex);
        }
        std::vector<Node> roots;
        for (unsigned i = 0; i < tree_.num_roots(); ++i) { roots.push_back(tree_.root_handle(i)); }
        front_.clear();
        front_.init(roots, static_cast<unsigned>(tree_.num_nodes() - tree_.num_roots()) / 2);
    }

    void split_all() override {
        for (const std::uint32_t node : order_) {
            if (front_.is_active(handles_[node])) { force(handles_[node]); }
        }
    }

    FaceSet faces() const override {
        std::vector<std::uint32_t> leaf_of(source_.leaf_count(), none);
        for (std::uint32_t leaf = 0; leaf < source_.leaf_count(); ++leaf) { leaf_of[vertices_[leaf]] = leaf; }
        FaceSet faces;
        for (const OpenMesh::FaceHandle face : mesh_.faces()) {
            std::array<std::uint32_t, 3> corners{};
            std::size_t k = 0;
            for (const Vertex vertex : mesh_.fv_range(face)) {
                corners.at(k++) = leaf_of[static_cast<std::size_t>(vertex.idx())];
            }
            faces.push_back(corners);
        }
        sort_faces(faces);
        return faces;
    }

private:
    /// Its nodes and vertices lie in the order in which they come. A split keeps its vertex for the first child, as
    /// ours, and adds one for the second.
    void number_vertices() {
        std::uint32_t next = 0;
        for (const std::uint32_t root : source_.roots()) { vertices_[root] = next++; }
        for (const std::uint32_t node : order_) {
            vertices_[source_.split_of(node).first] = vertices_[node];
            vertices_[source_.split_of(node).second] = next++;
        }
    }

    void make_nodes() {
        const auto roots = static_cast<unsigned>(source_.roots().size());
        tree_.set_num_roots(roots);
        std::vector<unsigned> depths(source_.node_count(), 0);
        for (unsigned i = 0; i < roots; ++i) {
            const Node made = tree_.add_node();
            tree_.node(made).set_index(tree_.generate_node_index(i, 1));
            put(source_.roots()[i], made);
        }
        for (const std::uint32_t node : order_) {
            const visuals::refine::Split split = source_.split_of(node);
            const unsigned depth = depths[node] + 1;
            if (depth + 1U + tree_.tree_id_bits() > 32U) {
                throw std::runtime_error("hierarchy too deep for OpenMesh's 32-bit node numbers");
            }
            depths[split.first] = depth;
            depths[split.second] = depth;
            Node parent = handles_[node];
            tree_.make_children(parent);
            put(split.second, tree_.lchild_handle(parent));
            put(split.first, tree_.rchild_handle(parent));
        }
        for (std::uint32_t node = static_cast<std::uint32_t>(source_.leaf_count()); node < source_.node_count();
             ++node) {
            // OpenMesh has left and right seen from the added vertex.
            const std::uint32_t left = source_.split_of(node).right_cut;
            const std::uint32_t right = source_.split_of(node).left_cut;
            if (left != none) { tree_.node(handles_[node]).set_fund_lcut(tree_.node_index(handles_[left])); }
            if (right != none) { tree_.node(handles_[node]).set_fund_rcut(tree_.node_index(handles_[right])); }
        }
    }

    void put(std::uint32_t node, Node made) {
        handles_[node] = made;
        tree_.node(made).set_vertex_handle(Vertex(static_cast<int>(vertices_[node])));
        tree_.node(made).set_normal(vec(source_.normal(node)));
    }

    void make_base() {
        const double before = heap_bytes_now();
        std::vector<std::uint32_t> node_of(source_.leaf_count(), none);
        for (const std::uint32_t root : source_.roots()) { node_of[vertices_[root]] = root; }
        for (std::uint32_t vertex = 0; vertex < source_.leaf_count(); ++vertex) {
            const std::uint32_t node = node_of[vertex];
            const Vertex made = base_.add_vertex(node == none ? OpenMesh::Vec3f(0.0F) : vec(source_.position_m(node)));
            if (node != none) { base_.data(made).set_vhierarchy_node_handle(handles_[node]); }
        }
        const std::vector<bool> is_base = source_.base_faces();
        for (std::size_t face = 0; face < is_base.size(); ++face) {
            if (is_base[face]) {
                std::array<Vertex, 3> corners;
                for (std::size_t k = 0; k < 3; ++k) {
                    std::uint32_t node = source_.faces()[face][k];
                    while (source_.parent(node) != none) { node = source_.parent(node); }
                    corners.at(k) = Vertex(static_cast<int>(vertices_[node]));
                }
                base_.add_face(corners[0], corners[1], corners[2]);
            }
        }
        base_bytes_ = heap_bytes_now() - before;
    }

    void find_cuts(Node node, Vertex& left, Vertex& right) {
        const NodeIndex left_index = tree_.fund_lcut_index(node);
        const NodeIndex right_index = tree_.fund_rcut_index(node);
        const bool has_left = left_index.is_valid(tree_.tree_id_bits());
        const bool has_right = right_index.is_valid(tree_.tree_id_bits());
        left.invalidate();
        right.invalidate();
        for (auto at = mesh_.vv_iter(tree_.vertex_handle(node)); at.is_valid(); ++at) {
            const NodeIndex index = tree_.node_index(mesh_.data(*at).vhierarchy_node_handle());
            if (has_left && !left.is_valid() && tree_.is_ancestor(index, left_index)) { left = *at; }
            if (has_right && !right.is_valid() && tree_.is_ancestor(index, right_index)) { right = *at; }
            if (left.is_valid() && right.is_valid()) { break; }
        }
    }

    void force(Node node) {
        Vertex left;
        Vertex right;
        find_cuts(node, left, right);
        while (left == right) {
            force(mesh_.data(left).vhierarchy_node_handle());
            find_cuts(node, left, right);
        }
        split(node, left, right);
    }

    void split(Node node, Vertex left, Vertex right) {
        const Node added = tree_.lchild_handle(node);
        const Node kept = tree_.rchild_handle(node);
        const Vertex v0 = tree_.vertex_handle(added);
        const Vertex v1 = tree_.vertex_handle(kept);
        mesh_.vertex_split(v0, v1, left, right);
        mesh_.set_normal(v0, tree_.normal(added));
        mesh_.set_normal(v1, tree_.normal(kept));
        mesh_.data(v0).set_vhierarchy_node_handle(added);
        mesh_.data(v1).set_vhierarchy_node_handle(kept);
        mesh_.status(v0).set_deleted(false);
        mesh_.status(v1).set_deleted(false);
        front_.remove(node);
        front_.add(added);
        front_.add(kept);
    }

    const visuals::refine::ProgressiveMesh& source_;
    std::vector<std::uint32_t> order_;
    OpenMesh::VDPM::VHierarchy tree_;
    OpenMesh::VDPM::VFront front_;
    Mesh base_;
    Mesh mesh_;
    std::vector<Node> handles_;           ///< by our nodes
    std::vector<std::uint32_t> vertices_; ///< by our nodes
    double base_bytes_ = 0.0;
};

} // namespace

std::unique_ptr<PeerRefinement> openmesh_refinement(const Hierarchy& mesh, SplitOrder order) {
    auto made = std::make_unique<OpenMeshRefinement>(mesh, order);
    made->name = order == SplitOrder::BySubtree ? "OpenMesh VDPM, by subtree" : "OpenMesh VDPM, coarse first";
    return made;
}

} // namespace octant::tests::peers
