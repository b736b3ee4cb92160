#include "tests/visuals/refine/front_check.h"
#include "tests/visuals/refine/made_sequence.h"
#include "visuals/refine/classic_split_rules.h"
#include "visuals/refine/selective_refiner.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

using namespace octant;
using namespace octant::visuals::refine;
using namespace octant::visuals::refine::test;

namespace {

std::shared_ptr<const ProgressiveMesh> hierarchy(const models::CollapseSequence& sequence) {
    return std::make_shared<const ProgressiveMesh>(sequence);
}

std::uint32_t node_of(const ProgressiveMesh& mesh, std::uint32_t sequence_number) {
    std::uint32_t node = 0;
    while (mesh.sequence_number(node) != sequence_number) { ++node; }
    return node;
}

void split_all(SelectiveRefiner& refiner) {
    const ProgressiveMesh& mesh = refiner.mesh();
    for (auto node = static_cast<std::uint32_t>(mesh.node_count()); node-- > mesh.leaf_count();) {
        refiner.split(node);
    }
}

/// Splits and collapses of nodes drawn by chance.
void walk(SelectiveRefiner& refiner, int operations, std::uint64_t seed) {
    std::mt19937_64 numbers(seed);
    const std::size_t leaves = refiner.mesh().leaf_count();
    const std::size_t inner = refiner.mesh().node_count() - leaves;
    for (int done = 0; done < operations;) {
        const auto node = static_cast<std::uint32_t>(leaves + numbers() % inner);
        if (refiner.is_active(node)) {
            done += refiner.split(node) > 0 ? 1 : 0;
        } else if (refiner.is_split(node)) {
            const VertexSplit split = refiner.mesh().split_of(node);
            const bool ready = refiner.is_active(split.first) && refiner.is_active(split.second);
            done += ready ? 1 : 0;
            refiner.collapse(node);
        }
    }
}

} // namespace

TEST_CASE("a split of an open strip brings both triangles back, a collapse takes them away") {
    models::CollapseSequence sequence;
    sequence.original.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
    sequence.original.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
    sequence.collapses = {
        {.first = 0, .second = 3, .position_m = {0, 0.5, 0}, .left = none, .right = 1, .error_m = 0.1}};
    SelectiveRefiner refiner(hierarchy(sequence));
    CHECK(refiner.active_count() == 4);
    CHECK(refiner.face_count() == 2);
    CHECK(refiner.split(5) == 1);
    CHECK(refiner.split(5) == 0);
    CHECK(refiner.active_count() == 5);
    CHECK(active_faces(refiner) == NamedFaces{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}});
    CHECK(refiner.collapse(5));
    CHECK_FALSE(refiner.collapse(5));
    CHECK(active_faces(refiner) == NamedFaces{{1, 2, 5}, {1, 4, 2}});
}

TEST_CASE("a split whose two cut vertices are one active node forces that node, and only it") {
    //  4---0      3 lies in the middle of 0 1 2. It collapses into 0, which makes 5: cut vertices
    //   \\ /|\\     1 and 2. Then 1 and 2 make 6, and the base mesh is the triangle 5 4 6.
    //    1-3-2
    models::CollapseSequence sequence;
    sequence.original.vertices_m = {{0, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, 0}, {-2, 1, 0}};
    sequence.original.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 1}};
    sequence.collapses = {{.first = 3, .second = 0, .position_m = {0, 1, 0}, .left = 0, .right = 2, .error_m = 0.1},
        {.first = 1, .second = 2, .position_m = {-1, -1, 0}, .left = 1, .error_m = 0.2}};
    const auto mesh = hierarchy(sequence);
    const std::uint32_t five = node_of(*mesh, 5);
    const std::uint32_t six = node_of(*mesh, 6);
    SelectiveRefiner refiner(mesh);
    CHECK(active_faces(refiner) == NamedFaces{{4, 6, 5}});
    CHECK(refiner.split(five) == 2);
    CHECK(refiner.counts().forced_by_rule == 1);
    CHECK(active_faces(refiner) == NamedFaces{{0, 1, 3}, {0, 3, 2}, {0, 4, 1}, {1, 2, 3}});
    // Now 1 and 2 would leave the triangles 0 3 6 and 3 0 6.
    CHECK_FALSE(refiner.collapse(six));
    CHECK(refiner.counts().blocked == 1);
    CHECK(refiner.collapse(five));
    CHECK(refiner.collapse(six));

    SelectiveRefiner the_other_first(mesh);
    CHECK(the_other_first.split(six) == 1);
    CHECK(active_faces(the_other_first) == NamedFaces{{1, 2, 5}, {1, 5, 4}});
    CHECK(the_other_first.split(five) == 1);
    CHECK(the_other_first.counts().forced_by_rule == 0);
}

TEST_CASE("everything split is the original, face for face") {
    for (const auto& made : {made_sphere(3), made_torus(24, 10), made_grid(12), made_ground(25, 7)}) {
        const models::CollapseSequence sequence = collapsed(made);
        for (const bool repair : {false, true}) {
            SelectiveRefiner refiner(hierarchy(sequence), {.repair = repair});
            split_all(refiner);
            CHECK(refiner.repair() == 0);
            CHECK(refiner.flipped_faces() == 0);
            CHECK(refiner.counts().forced_by_rule == 0);
            NamedFaces original;
            for (models::Triangle face : made.triangles) {
                std::rotate(face.begin(), std::ranges::min_element(face), face.end());
                original.push_back(face);
            }
            std::ranges::sort(original);
            CHECK(active_faces(refiner) == original);
            for (std::uint32_t leaf = 0; leaf < refiner.mesh().leaf_count(); ++leaf) {
                const std::uint32_t number = refiner.mesh().sequence_number(leaf);
                const glm::dvec3 moved_m = made.vertices_m[number] - refiner.mesh().parts().origin_m;
                const glm::vec3& drawn_m = refiner.vertices()[refiner.slot(leaf)].position_m;
                INFO(drawn_m.x << " " << moved_m.x);
                CHECK(drawn_m == glm::vec3(moved_m));
            }
        }
    }
}

TEST_CASE("any state is what file and list of active nodes say, a manifold of one topology") {
    for (const auto& made : {made_sphere(3), made_torus(20, 9), made_ground(17, 11)}) {
        const models::CollapseSequence sequence = collapsed(made);
        for (const bool repair : {false, true}) {
            SelectiveRefiner refiner(hierarchy(sequence), {.repair = repair});
            const long euler = euler_characteristic(active_faces(refiner));
            for (std::uint64_t round = 0; round < 20; ++round) {
                walk(refiner, 200, 31 * round + 1);
                const NamedFaces faces = active_faces(refiner);
                CHECK(faces == expected_faces(sequence, refiner));
                CHECK(faces.size() == refiner.face_count());
                CHECK(manifold_fault(refiner).empty());
                CHECK(euler_characteristic(faces) == euler);
            }
        }
    }
}

TEST_CASE("after 100,000 random splits and collapses the mesh is a manifold of the same topology") {
    for (const auto& made : {made_torus(40, 20), made_ground(30, 2)}) {
        const models::CollapseSequence sequence = collapsed(made);
        SelectiveRefiner refiner(hierarchy(sequence), {.repair = false});
        const long euler = euler_characteristic(active_faces(refiner));
        walk(refiner, 100000, 5);
        CHECK(active_faces(refiner) == expected_faces(sequence, refiner));
        CHECK(manifold_fault(refiner).empty());
        CHECK(euler_characteristic(active_faces(refiner)) == euler);
        CHECK(refiner.counts().splits > 40000);
        CHECK(refiner.counts().collapses > 30000);
    }
}

TEST_CASE("operations need no memory once everything was split and collapsed") {
    SelectiveRefiner refiner(hierarchy(collapsed(made_ground(30, 2))), {.repair = false});
    split_all(refiner);
    CHECK(refiner.bytes() <= 60 * refiner.active_count()); // index list included
    const ProgressiveMesh& mesh = refiner.mesh();
    for (auto node = static_cast<std::uint32_t>(mesh.leaf_count()); node < mesh.node_count(); ++node) {
        refiner.collapse(node);
    }
    const std::size_t bytes = refiner.bytes();
    walk(refiner, 20000, 3);
    CHECK(refiner.bytes() == bytes);
}

TEST_CASE("repair leaves no face turned over") {
    const models::CollapseSequence sequence = collapsed(made_sphere(4));
    const auto mesh = hierarchy(sequence);
    SelectiveRefiner bare(mesh, {.repair = false});
    SelectiveRefiner repaired(mesh);
    std::size_t turned = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        walk(bare, 300, seed);
        turned += bare.flipped_faces();
        walk(repaired, 300, seed);
        repaired.repair();
        CHECK(repaired.flipped_faces() == 0);
    }
    CHECK(turned > 0);
    CHECK(bare.repair() == 0);
    CHECK(repaired.counts().forced_by_repair > 0);
}

TEST_CASE("the earlier rules give the same meshes for more splits") {
    const models::CollapseSequence sequence = collapsed(made_sphere(4));
    const auto mesh = hierarchy(sequence);
    std::array<std::size_t, 3> splits{};
    for (const SplitRule rule : {SplitRule::Selective, SplitRule::Hoppe, SplitRule::Xia}) {
        SelectiveRefiner refiner(mesh, {.required_split = required_split_of(rule, *mesh), .repair = false});
        for (std::uint32_t leaf = 0; leaf < 20; ++leaf) {
            for (std::uint32_t node = mesh->parent(leaf); node != none; node = mesh->parent(node)) {
                refiner.split(node);
            }
        }
        splits[static_cast<std::size_t>(rule)] = refiner.counts().splits;
        CHECK(active_faces(refiner) == expected_faces(sequence, refiner));
        CHECK(manifold_fault(refiner).empty());
        split_all(refiner);
        CHECK(refiner.face_count() == mesh->face_count());
    }
    CHECK(splits[0] < splits[1]);
    CHECK(splits[1] < splits[2]);
}

TEST_CASE("only what was written since the last look is dirty") {
    SelectiveRefiner refiner(hierarchy(collapsed(made_sphere(4))));
    split_all(refiner);
    std::vector<SlotRange> ranges;
    refiner.take_dirty_vertices(ranges);
    CHECK(ranges == std::vector<SlotRange>{{0, refiner.vertices().size()}});
    refiner.take_dirty_faces(ranges);
    CHECK(ranges == std::vector<SlotRange>{{0, refiner.indices().size() / 3}});
    refiner.take_dirty_vertices(ranges);
    CHECK(ranges.empty());
    const std::vector<std::uint32_t> before(refiner.indices().begin(), refiner.indices().end());
    CHECK(refiner.collapse(static_cast<std::uint32_t>(refiner.mesh().leaf_count())));
    refiner.take_dirty_faces(ranges);
    REQUIRE(!ranges.empty());
    for (std::size_t place = 0; 3 * place < before.size(); ++place) {
        const bool dirty = std::ranges::any_of(
            ranges, [&](const SlotRange& range) { return place >= range.first && place < range.end; });
        CHECK((dirty || std::equal(before.begin() + static_cast<std::ptrdiff_t>(3 * place),
                            before.begin() + static_cast<std::ptrdiff_t>(3 * place + 3),
                            refiner.indices().begin() + static_cast<std::ptrdiff_t>(3 * place))));
    }
}

TEST_CASE("splits handed over in one call leave the mesh that they leave one by one") {
    const auto mesh = hierarchy(collapsed(made_sphere(4)));
    std::mt19937 numbers(3);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{300}}) {
        std::vector<std::uint32_t> nodes;
        const std::size_t leaves = mesh->leaf_count();
        for (std::size_t i = 0; i < count; ++i) {
            nodes.push_back(static_cast<std::uint32_t>(leaves + numbers() % (mesh->node_count() - leaves)));
        }
        SelectiveRefiner together(mesh);
        SelectiveRefiner apart(mesh);
        SelectiveRefiner once_more(mesh);
        const std::size_t done = together.split_all(nodes);
        for (const std::uint32_t node : nodes) { apart.split(node); }
        CHECK(done == apart.counts().splits);
        CHECK(together.counts().splits == done);
        CHECK(together.counts().forced_by_rule <= apart.counts().forced_by_rule);
        CHECK(active_faces(together) == active_faces(apart));
        std::ranges::reverse(nodes); // their order does not matter
        CHECK(once_more.split_all(nodes) == done);
        CHECK(std::ranges::equal(together.indices(), once_more.indices()));
    }
}

TEST_CASE("only splits that were not asked for in a call count as forced") {
    const auto mesh = hierarchy(collapsed(made_sphere(4)));
    std::mt19937 numbers(11);
    std::size_t forced = 0;
    for (int round = 0; round < 50; ++round) {
        std::vector<bool> wanted(mesh->node_count(), false);
        for (int i = 0; i < 3; ++i) {
            auto node = static_cast<std::uint32_t>(numbers() % mesh->leaf_count());
            while ((node = mesh->parent(node)) != none) { wanted[node] = true; }
        }
        std::vector<std::uint32_t> nodes;
        for (std::uint32_t node = 0; node < wanted.size(); ++node) {
            if (wanted[node]) { nodes.push_back(node); }
        }
        SelectiveRefiner refiner(mesh, {.repair = false});
        CHECK(refiner.split_all(nodes) == refiner.counts().splits);
        CHECK(refiner.counts().forced_by_rule == refiner.counts().splits - nodes.size());
        forced += refiner.counts().forced_by_rule;
    }
    CHECK(forced > 0);
}

TEST_CASE("what a split will force is what it forces") {
    std::size_t all = 0;
    for (const auto& made : {made_sphere(4), made_torus(40, 20), made_ground(30, 2)}) {
        const auto mesh = hierarchy(collapsed(made));
        std::mt19937 numbers(5);
        std::vector<std::uint32_t> forced;
        for (int round = 0; round < 20; ++round) {
            SelectiveRefiner refiner(mesh, {.records_splits = true, .repair = false});
            std::uint32_t leaf = static_cast<std::uint32_t>(numbers() % mesh->leaf_count());
            while (!refiner.is_active(leaf)) {
                const std::uint32_t node = refiner.active_ancestor(leaf);
                refiner.find_forced_splits(node, forced);
                refiner.clear_recent_splits();
                refiner.split(node);
                all += forced.size();
                forced.push_back(node);
                CHECK(std::ranges::equal(forced, refiner.recent_splits()));
            }
        }
    }
    CHECK(all > 5);
}

TEST_CASE("a front that starts again is as a new one") {
    const auto mesh = hierarchy(collapsed(made_torus(12, 8)));
    SelectiveRefiner used(mesh);
    walk(used, 200, 5);
    used.restart();
    SelectiveRefiner fresh(mesh);
    CHECK(used.active_count() == fresh.active_count());
    CHECK(active_faces(used) == active_faces(fresh));
    split_all(used);
    split_all(fresh);
    CHECK(std::ranges::equal(used.indices(), fresh.indices()));
}
