#include "models/polygons/obj_reader.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "visuals/certificate/order_certificate.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/verify.h"

#include <catch2/catch.hpp>

#include <fmt/format.h>
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
    return visuals::certificate::order_certificate(ordered.model, ordered.order, {});
}

VerificationResult verdict_of(const std::string& text) {
    const auto file = tests::scratch_folder() / "certificate.txt";
    write_file(file, text);
    return visuals::verify::verify(visuals::verify::read_certificate(file));
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
