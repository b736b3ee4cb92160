#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/verify.h"

#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <string>

using namespace octant;
using namespace octant::visuals::verify;

namespace {

/// Two squares that both face +z, one at z = 0 and one at z = 1.
const std::string model = R"(octant-certificate 2
model 0123 a model by hand
tolerance 1e-9
vertex 0 0 0
vertex 1 0 0
vertex 1 1 0
vertex 0 1 0
vertex 0 0 1
vertex 1 0 1
vertex 1 1 1
vertex 0 1 1
polygon 0 0 0 1 0  0 1 2 3
polygon 1 0 0 1 -1  4 5 6 7
)";

/// A square at z = 0 and one across it at x = 2, which faces -x.
const std::string corner = R"(octant-certificate 2
model 0123 a model by hand
tolerance 1e-9
vertex 0 0 0
vertex 1 0 0
vertex 1 1 0
vertex 0 1 0
vertex 2 0 -1
vertex 2 0 1
vertex 2 1 1
vertex 2 1 -1
polygon 0 0 0 1 0  0 1 2 3
polygon 1 -1 0 0 2  4 5 6 7
)";

std::filesystem::path file_of(const std::string& text) {
    const auto file = tests::scratch_folder() / "certificate.txt";
    write_file(file, text);
    return file;
}

VerificationResult verdict_of(const std::string& text) {
    return visuals::verify::verify(CertificateReader(file_of(text)));
}

/// The line and the text of the first false claim; empty if there is none.
std::string refusal_of(const std::string& text) {
    const VerificationResult result = verdict_of(text);
    return result.failure ? fmt::format("{}: {}", result.failure->line, result.failure->what) : "";
}

std::string error_of(const std::string& text) {
    try {
        visuals::verify::verify(CertificateReader(file_of(text)));
    } catch (const Error& error) {
        const std::string what = error.what();
        return what.substr(what.find("certificate.txt") + 15);
    }
    return "";
}

} // namespace

TEST_CASE("of two squares that face alike the farther one is painted first") {
    const VerificationResult result = verdict_of(model + "list 0 1\npairs list 0 1 1l\n");
    CHECK(result.proved());
    CHECK(result.pairs == 1);
    CHECK(result.statements.by_polygons == 1);
}

TEST_CASE("the point from which a certificate measures changes nothing") {
    std::string far = model + "list 0 1\npairs list 0 1 1l\n";
    far.insert(far.find("vertex"), "about 1e6 -1e6 0\n");
    CHECK(verdict_of(far).proved());
}

TEST_CASE("the nearer one painted first is refused, whatever the witness") {
    CHECK(refusal_of(model + "list 1 0\npairs list 0 0 1l\n") ==
          "15: expected polygon 1 behind the plane of polygon 0, got a corner before it");
    CHECK(refusal_of(model + "list 1 0\npairs list 0 0 1e\n") ==
          "15: expected polygon 0 before the plane of polygon 1, got a corner behind it");
    CHECK_FALSE(refusal_of(model + "list 1 0\nsum list 0 1 0 1 0 0\n").empty());
    CHECK_FALSE(refusal_of(model + "list 1 0\nsum list 0 1 0 0 0 0\n").empty());
    CHECK_FALSE(refusal_of(model + "list 1 0\nnever list 0 1 0 1 0 0\n").empty());
}

TEST_CASE("a pair without a proof is refused, one that says so is counted") {
    CHECK(
        refusal_of(model + "list 0 1\n") == "14: expected a proof that polygon 0 hides nothing of polygon 1, got none");
    const VerificationResult result = verdict_of(model + "list 0 1\nunproved list 0 0 1\n");
    CHECK_FALSE(result.failure);
    CHECK(result.unproved == 1);
    CHECK_FALSE(result.proved());
}

TEST_CASE("a polygon that is not painted has to face away") {
    CHECK(refusal_of(model + "list 0\n") == "14: expected polygon 1 painted or proved to face away, got neither");
    const std::string two_cells = model + "list 0 1\nlist 0 1\nlist 0\n"
                                          "node choice 0 0 1 -1 list 0 node 1\n"
                                          "node choice 0 0 1 -0.5 list 1 list 2\n"
                                          "pairs node 0 1 1l 1-\n";
    CHECK(refusal_of(two_cells).starts_with("16: expected polygon 1 painted or proved"));
    // Its plane and the walls of the cell, 1 - z and 0.5 - z, add up to nothing.
    CHECK(verdict_of(two_cells + "away list 2 1 0 0:1\n").proved());
    CHECK_FALSE(verdict_of(two_cells + "away list 2 1 0\n").proved());
    CHECK_FALSE(verdict_of(two_cells + "away list 2 0 0 0:1\n").proved());
}

TEST_CASE("a wall decides all pairs that it parts") {
    const std::string halves = corner + "list 1 0\nlist 0 1\nnode choice 1 0 0 -1.5 list 1 list 0\n";
    CHECK(verdict_of(halves).proved());
    CHECK(refusal_of(corner + "list 0 1\nlist 1 0\nnode choice 1 0 0 -1.5 list 1 list 0\n") != "");
}

TEST_CASE("a sum of planes decides a pair, and no factor may be altered much") {
    // x - 1.5 as the sum of two walls, 2x + z - 3 and -z.
    const std::string cell = corner + "list 0 1\nlist 1 0\nlist 0 1\n"
                                      "node choice 0 0 -1 0 node 1 list 2\n"
                                      "node choice 1 0 0.5 -1.5 list 0 list 1\n"
                                      "pairs node 0 1 1- 1-\n";
    const std::string others = "\nunproved list 1 1 0\nunproved list 2 0 1\n";
    CHECK_FALSE(verdict_of(cell + "sum list 0 0 1 0 0 0 0:0.5 1:1" + others).failure);
    CHECK_FALSE(verdict_of(cell + "sum list 0 0 1 0 0 0 0:0.4 1:1" + others).failure);
    CHECK(verdict_of(cell + "sum list 0 0 1 0 0 0 0:10 1:1" + others).failure);
    CHECK(verdict_of(cell + "sum list 0 0 1 0 0 1 0:0.5 1:1" + others).failure);
    CHECK(verdict_of(cell + "sum list 0 1 0 0 0 0 0:0.5 1:1" + others).failure);
}

TEST_CASE("a parting decides all pairs across it") {
    const std::string lists = model + "list 1\nlist 0\n";
    CHECK(verdict_of(lists + "node parting 0 0 1 -0.5 list 0 list 1 nothing nothing\n").proved());
    CHECK(verdict_of(lists + "node parting 0 0 1 0 list 0 nothing list 1 nothing\n").proved());
    CHECK(refusal_of(lists + "node parting 0 0 1 -0.5 list 1 list 0 nothing nothing\n") ==
          "16: expected polygon 0 before the plane, got a corner elsewhere");
    CHECK(refusal_of(lists + "node parting 0 0 1 0 list 0 nothing nothing list 1\n") ==
          "16: expected polygon 0 facing as the plane, got a corner elsewhere");
    CHECK(refusal_of(lists + "node parting 1 0 0 -0.5 list 0 list 1 nothing nothing\n") != "");
}

TEST_CASE("of a sequence the first part hides nothing of the other one") {
    const std::string lists = model + "list 0\nlist 1\n";
    CHECK(verdict_of(lists + "node sequence list 0 list 1\npairs node 0 1 1l\n").proved());
    CHECK_FALSE(verdict_of(lists + "node sequence list 0 list 1\n").proved());
    CHECK_FALSE(verdict_of(lists + "node sequence list 1 list 0\npairs node 0 0 1l\n").proved());
    CHECK(refusal_of(model + "list 0 1\nlist 1\nnode sequence list 0 list 1\n") ==
          "16: expected each polygon painted once, got 1 again");
}

TEST_CASE("a decal is painted over what it lies on, whatever its file says of planes") {
    const std::string stacked = R"(octant-certificate 2
model 0123 a model by hand
tolerance 1e-9
vertex 0 0 0
vertex 1 0 0
vertex 1 1 0
vertex 0 1 0
vertex 0.2 0.2 0
vertex 0.8 0.2 0
vertex 0.8 0.8 0
vertex 0.2 0.8 0
polygon 0 0 0 1 0  0 1 2 3
polygon 1 0 0 1 0  4 5 6 7
)";
    CHECK(verdict_of(stacked + "list 0 1\npairs list 0 1 1e\n").proved());
    CHECK(refusal_of(stacked + "list 1 0\npairs list 0 0 1e\n")
              .starts_with("14: expected polygon 1 painted over polygon 0"));
}

TEST_CASE("a polygon that turns is judged by all that it sweeps") {
    // A blade about the z axis, which reaches to x = 2 at another angle, and a wall at x = 1.5.
    const std::string rotor = R"(octant-certificate 2
model 0123 a model by hand
tolerance 1e-9
vertex 0 0 0
vertex 0 2 0
vertex -0.1 2 0
vertex 1.5 0 -1
vertex 1.5 1 -1
vertex 1.5 1 -0.5
axis 0 0 0 0 0 1
turning 0 0 0 0 1 0  0 1 2
polygon 1 1 0 0 -1.5  3 4 5
)";
    CHECK(verdict_of(rotor + "list 1 0\npairs list 0 0 1l\n").proved());
    CHECK(refusal_of(rotor + "list 0 1\npairs list 0 1 1l\n") ==
          "14: expected polygon 0 behind the plane of polygon 1, got a corner before it");
}

TEST_CASE("polygons lie in their planes and face to the front of them") {
    CHECK(refusal_of(model + "polygon 2 0 0 1 -1  0 1 2 3\nlist 0\n")
              .starts_with("14: expected all corners in the polygon's plane"));
    CHECK(refusal_of(model + "polygon 2 0 0 1 0  3 2 1 0\nlist 0\n")
              .starts_with("14: expected corners counter-clockwise"));
}

TEST_CASE("a tolerance that would prove anything is no tolerance") {
    std::string loose = model + "list 0 1\npairs list 0 1 1l\n";
    loose.replace(loose.find("1e-9"), 4, "0.1");
    CHECK_THROWS_AS(verdict_of(loose), Error);
}

TEST_CASE("what faces away from all eyes of a choice is missing in all lists below") {
    // Only eyes below z = 0.5 come to the inner choice: they do not see the square at z = 1.
    const std::string cells = model + "list 0 1\nlist 0\nlist 0\n"
                                      "node choice 0 0 1 -0.5 list 0 node 1\n"
                                      "node choice 1 0 0 -0.5 list 1 list 2\n"
                                      "pairs node 0 1 1l 1-\n";
    CHECK(verdict_of(cells + "away node 1 1 0 0:1\n").proved());
    CHECK(verdict_of(cells + "away node 1 1 0 0:1\n").unlisted == 1);
    CHECK_FALSE(verdict_of(cells + "away node 1 1 0 0:0.5\n").proved());
    CHECK_FALSE(verdict_of(cells + "away list 1 1 0 0:1\n").proved()); // not in list 2
}

TEST_CASE("statements come in the order of the tree, and long lines go on in the next one") {
    const std::string halves = model + "list 1\nlist 0\nnode sequence list 1 list 0\n";
    const std::string parts = model + "list 0 \\\n1\nlist 0 1\nnode choice 0 0 1 -3 list 0 list 1\n";
    const std::string first = "unproved list 0 0 1\n";
    const std::string second = "unproved list 1 0 1\n";
    CHECK(verdict_of(parts + first + second).unproved == 2);
    CHECK(verdict_of(parts + second + first).failure);
    CHECK(error_of(parts + first + second + first) ==
          ":20: expected statements in the order of the tree, each node's before those of its children, got one about "
          "list 0");
    CHECK(verdict_of(halves + "pairs node 0 1 1l\n").proved());
}

TEST_CASE("a certificate of another version or of no model is refused") {
    std::string old = model + "list 0 1\n";
    old.replace(old.find("certificate 2"), 13, "certificate 1");
    CHECK(error_of(old) == ":1: expected version 2 of the format (octant draw-order --certificate writes it), got '1'");
    std::string unbound = model + "list 0 1\n";
    unbound.erase(unbound.find("model"), unbound.find("tolerance") - unbound.find("model"));
    CHECK(error_of(unbound) == ":14: expected a model before here, got none");
    CHECK(error_of(model + "model 1 again\n").starts_with(":14: expected one model"));
}

TEST_CASE("what is no certificate is refused with its line") {
    CHECK(error_of("") == ": expected 'octant-certificate 2' first, got an empty file");
    CHECK(error_of("draworder 1\n") == ":1: expected 'octant-certificate 2' first, got 'draworder'");
    CHECK(error_of(model + "vortex\n").starts_with(":14: expected model, tolerance, about, vertex"));
    CHECK(error_of(model + "vertex 1 2\n").ends_with("got none"));
    CHECK(error_of(model + "about 1 2 3\n").starts_with(":14: expected 'about' before all places"));
    CHECK(error_of(model + "vertex 1 2 inf\n").ends_with("got 'inf'"));
    CHECK(error_of(model + "polygon 2 0 0 9 0  0 1 2\n") == ":14: expected a normal of length 1, got '9'");
    CHECK(error_of(model + "polygon 2 0 0 1 0  0 1 8\n") == ":14: expected a vertex (0 to 7), got '8'");
    CHECK(error_of(model + "list 0 1 0\n") == ":14: expected each polygon once, got '0'");
    CHECK(error_of(model) == ":14: expected at least one list before here, got none");
    const std::string two = model + "list 0\nlist 1\n";
    CHECK(error_of(two) == ":15: expected list 1 to be the child of an earlier node, got none");
    CHECK(error_of(two + "node sequence list 0 list 0\n") ==
          ":16: expected children that are there, each of one node, got list 0");
    CHECK(error_of(two + "node choice 0 0 1 0 nothing list 0\n").starts_with(":16: expected node K, list K"));
    CHECK(error_of(two + "node sequence node 0 list 0\n") == ":16: expected a later node, got '0'");
    const std::string one = model + "list 0 1\n";
    CHECK(error_of(one + "pairs list 0 1 1x\n") == ":15: expected a count with e, l or -, got '1x'");
    CHECK(error_of(one + "sum list 0 0 1 -1 0 0\n").starts_with(":15: expected a factor"));
    CHECK(error_of(one + "sum list 0 0 1 1 0 0 0:1\n") ==
          ":15: expected a region plane, 0 to below 0, and its factor, got '0:1'");
    CHECK(error_of(one + "away list 1 0 0\n") == ":15: expected a list (0 to 0), got '1'");
    CHECK(
        error_of(one + "pairs list 0 1 1l\nlist 0\n").starts_with(":16: expected pairs, sum, never, away or unproved"));
}
