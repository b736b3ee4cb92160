#include "models/planar/planar_model.h"
#include "models/polygons/file_axes.h"
#include "models/polygons/obj_reader.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "visuals/certificate/order_certificate.h"
#include "visuals/draworder/occlusion.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/draworder/view_cell.h"
#include "visuals/draworder/view_region.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/verify.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

using namespace octant;
using visuals::certificate::OrderCertificate;
using visuals::verify::VerificationResult;

namespace {

models::polygons::PolygonModel read(const std::string& file) {
    return models::polygons::read_obj(std::string(OCTANT_SOURCE_DIR) + "/" + file);
}

/// Of the exact order, found by a search over eye space or, without one, by splitting polygons.
OrderCertificate certificate_of(const std::string& file, double search_s = 20.0) {
    const auto ordered = visuals::draworder::ordered(read(file), {.seconds = search_s});
    return visuals::certificate::order_certificate({ordered.model, ordered.order, {}, {"model", "0123456789abcdef"}});
}

VerificationResult verdict_of(const std::string& text) {
    const auto file = tests::scratch_folder() / "certificate.txt";
    write_file(file, text);
    return visuals::verify::verify(visuals::verify::CertificateReader(file));
}

void check_proved(const std::string& file) {
    for (const double search_s : {20.0, 0.0}) {
        const OrderCertificate certificate = certificate_of(file, search_s);
        const VerificationResult verdict = verdict_of(certificate.text);
        INFO(file << ": " << (verdict.failure ? verdict.failure->what : ""));
        CHECK(certificate.unproved == 0);
        CHECK(verdict.proved());
        CHECK(verdict.pairs > 0);
    }
}

/// The lines of a certificate, and the first one that begins with some words.
struct Lines {
    std::vector<std::string> all;

    explicit Lines(const std::string& text) {
        for (const std::string_view line : split_lines(text)) { all.emplace_back(line); }
    }

    std::size_t first(std::string_view beginning) const {
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i].starts_with(beginning)) { return i; }
        }
        FAIL("no line " << beginning);
        return 0;
    }

    std::string text() const { return fmt::format("{}\n", fmt::join(all, "\n")); }
};

/// A line with one of its words, counted from 0, replaced.
std::string with_word(const std::string& line, std::size_t at, const std::string& word) {
    std::string out;
    const auto words = split_words(line);
    for (std::size_t i = 0; i < words.size(); ++i) {
        out += (i == 0 ? "" : " ") + (i == at ? word : std::string(words[i]));
    }
    return out;
}

} // namespace

TEST_CASE("the orders of the aircraft are proved, by cells and by parts") {
    for (const char* name : {"f15", "500md", "concave"}) { check_proved(fmt::format("models/{}.obj", name)); }
}

TEST_CASE("the orders of models that are hard to order are proved") {
    for (const char* name : {"three-crossing-bars", "order-two-sided-33", "decal-decals-12", "order-slivers-12",
             "crash-t-junctions-15", "eighteen-polygons-far-away", "certificate-far-7001", "order-tiny-34"}) {
        check_proved(fmt::format("tests/fuzz/corpus/{}.obj", name));
    }
}

TEST_CASE("sides that are parallel but for the last digits of a file are proved, and say so") {
    const OrderCertificate certificate = certificate_of("tests/visuals/certificate/parallel-but-for-a-digit.obj");
    const VerificationResult verdict = verdict_of(certificate.text);
    CHECK(certificate.unproved == 0);
    CHECK(verdict.proved());
    CHECK(verdict.tolerance_sizes > 5e-8);
    CHECK(verdict.tolerance_sizes < 1e-6);
}

TEST_CASE("the same order gives the same certificate") {
    CHECK(certificate_of("models/concave.obj").text == certificate_of("models/concave.obj").text);
}

namespace {

/// Pairs of polygons of which one hides part of the other from some eye.
std::size_t overlapping_pairs(const models::polygons::PolygonModel& model) {
    const models::planar::PlanarModel planar = models::planar::planar_model(model);
    const auto faces = visuals::draworder::model_faces(planar.model, glm::dvec3(0.0));
    visuals::draworder::OcclusionGraphBuilder builder(faces);
    const auto graph = builder.all(visuals::draworder::ViewRegion::all_space());
    std::size_t pairs = 0;
    for (std::size_t a = 0; a < graph.count(); ++a) {
        for (std::size_t b = 0; b < a; ++b) { pairs += graph.occludes(a, b) || graph.occludes(b, a) ? 1U : 0U; }
    }
    return pairs;
}

} // namespace

TEST_CASE("a certificate has at most 100 bytes for each pair of polygons that overlap from some eye") {
    const std::string name = GENERATE("models/concave.obj", "models/f15.obj", "models/500md.obj",
        "models/f15-detailed.obj", "models/500md-detailed.obj", "tests/data/aircraft/orders/s7-x-soup60.obj");
    const std::size_t pairs = overlapping_pairs(read(name));
    const OrderCertificate certificate = certificate_of(name);
    const double bytes = static_cast<double>(certificate.text.size()) / static_cast<double>(pairs);
    std::fputs(fmt::format("{}: {} bytes, {} overlapping pairs, {:.1f} bytes a pair\n", name, certificate.text.size(),
                   pairs, bytes)
                   .c_str(),
        stdout);
    CHECK(bytes <= 100.0);
    CHECK(certificate.unproved == 0);
    CHECK(verdict_of(certificate.text).proved());
}

TEST_CASE("the hash of a model is that of its polygons, not of names and axes") {
    using visuals::certificate::model_hash;
    const models::polygons::PolygonModel f15 = read("models/f15.obj");
    const std::string hash = model_hash(f15, {});
    models::polygons::PolygonModel other = f15;
    other.name = "another name";
    for (models::Material& material : other.materials) { material.colour = glm::vec3(0.5F); }
    CHECK(model_hash(other, {}) == hash);
    const auto axes = models::polygons::FileAxes::from_text("back,right,up");
    const auto turned = models::polygons::read_obj(OCTANT_SOURCE_DIR "/models/f15.obj", axes);
    CHECK(model_hash(turned, axes) == hash);
    other.vertices_m[other.corner_vertices[0]].x += 1e-9;
    CHECK(model_hash(other, {}) != hash);
    models::polygons::PolygonModel less = f15;
    less.polygons.pop_back();
    CHECK(model_hash(less, {}) != hash);
}

TEST_CASE("a certificate in which one thing was changed is refused") {
    const Lines good(certificate_of("models/f15.obj").text);
    REQUIRE(verdict_of(good.text()).proved());
    const auto failure = [&](std::string_view beginning, const auto& change) {
        Lines changed = good;
        std::string& line = changed.all[changed.first(beginning)];
        line = change(line);
        INFO(line);
        CHECK(verdict_of(changed.text()).failure);
    };
    failure("vertex", [](const std::string& line) { return with_word(line, 1, "0.5"); });
    failure("polygon", [](const std::string& line) { return with_word(line, 5, "0.5"); });
    failure("node choice", [](const std::string& line) { return with_word(line, 5, "0.5"); });
    failure("list", [](const std::string& line) { return line.substr(0, line.rfind(' ')); });
    failure("list", [](const std::string& line) {
        const auto words = split_words(line);
        const std::string first(words[1]);
        const std::string last(words.back());
        return with_word(with_word(line, 1, last), words.size() - 1, first);
    });
    failure("pairs", [](const std::string& line) {
        std::string turned = line;
        for (std::size_t i = std::string("pairs node").size(); i < turned.size(); ++i) {
            turned[i] = turned[i] == 'e' ? 'l' : turned[i] == 'l' ? 'e' : turned[i];
        }
        return turned;
    });
    failure("pairs", [](const std::string& line) { return line + " 1-"; });
    failure("pairs", [](const std::string& line) { return "# " + line; });
    failure("sum", [](const std::string& line) { return "# " + line; });
    failure("sum", [](const std::string& line) { return with_word(line, 7, "1000"); });
    failure("away", [](const std::string& line) { return "# " + line; });
    failure("away", [](const std::string& line) { return with_word(line, 4, "1000"); });
}

TEST_CASE("a certificate in a file has the same text, and one that is too long is not written") {
    const auto ordered = visuals::draworder::ordered(read("models/f15.obj"));
    const models::polygons::FileAxes axes;
    const visuals::certificate::CertifiedModel bound_to{"model", "0123456789abcdef"};
    const visuals::certificate::CertifiedOrder proved{ordered.model, ordered.order, axes, bound_to};
    const std::string text = visuals::certificate::order_certificate(proved).text;
    const auto folder = tests::scratch_folder() / "proofs";
    make_folder(folder);
    const auto file = folder / "f15.proof";
    write_file(file.string() + ".part", "another file");
    CHECK(visuals::certificate::write_order_certificate(file, proved, text.size() - 1).is_too_long);
    CHECK(!path_exists(file));
    const auto written = visuals::certificate::write_order_certificate(file, proved, text.size());
    CHECK(written.bytes == text.size());
    CHECK(written.unproved == 0);
    CHECK(read_text_file(file) == text);
    CHECK(read_text_file(file.string() + ".part") == "another file");
    const auto left = std::distance(std::filesystem::directory_iterator(folder), {});
    CHECK(left == 2); // no temporary file
    const auto nowhere = folder / "none" / "f15.proof";
    CHECK_THROWS_WITH(visuals::certificate::write_order_certificate(nowhere, proved, text.size()),
        nowhere.string() + ": cannot be written: No such file or directory");
}

TEST_CASE("a certificate that ends anywhere before its end is refused with its line") {
    const std::string text = certificate_of("models/concave.obj").text;
    const auto file = tests::scratch_folder() / "cut.proof";
    REQUIRE(text.size() > 500);
    for (std::size_t bytes = 1; bytes + 1 < text.size(); ++bytes) { // the last byte is the end of a line
        write_file(file, text.substr(0, bytes));
        INFO(text.substr(0, bytes));
        try {
            const VerificationResult verdict = visuals::verify::verify(visuals::verify::CertificateReader(file));
            REQUIRE(verdict.failure);
            CHECK(verdict.failure->line > 0);
        } catch (const Error& fault) {
            const std::string named = file.string() + ":";
            const std::string words = fault.what();
            REQUIRE(words.starts_with(named));
            CHECK(words.find_first_not_of("0123456789", named.size()) > named.size());
        }
    }
}
