#include "ui/commands/certificates.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/commands/percent_progress.h"
#include "visuals/certificate/order_certificate.h"
#include "visuals/verify/certificate_reader.h"
#include "visuals/verify/verify.h"

#include <fmt/format.h>

namespace octant::ui::commands {

namespace {

namespace proofs = visuals::verify;

std::string certificate_text(const CertifiedOrder& proved, bool quiet, base::JsonValue& results) {
    PercentProgress percents("seeking proofs", quiet);
    const auto certificate = visuals::certificate::order_certificate(
        proved.model, proved.order, proved.axes, [&](std::size_t done, std::size_t all) {
            percents.show(static_cast<double>(done) / static_cast<double>(all));
        });
    results["certificate_ms"] = percents.finish();
    results["certificate_unproved"] = certificate.unproved;
    return certificate.text;
}

/// Checks a certificate without rounding and adds to the figures; whether it proves all.
bool all_proofs_hold(const proofs::Certificate& certificate, PercentProgress& percents, base::JsonValue& results) {
    const std::string file = certificate.path.string();
    const auto verdict = proofs::verify(certificate, [&](std::size_t done, std::size_t all) {
        percents.show(static_cast<double>(done) / static_cast<double>(all));
    });
    results["tolerance_sizes"] = verdict.tolerance_sizes;
    results["pairs"] = verdict.pairs;
    results["pairs_by_partings"] = verdict.by_node_planes;
    results["claims_by_polygons"] = verdict.claims.by_polygons;
    results["claims_by_sums"] = verdict.claims.by_sums;
    results["claims_never_seen"] = verdict.claims.never_both_visible;
    results["unlisted"] = verdict.unlisted;
    results["unproved"] = verdict.unproved;
    results["every_eye"] = verdict.covers_every_eye;
    if (certificate.first_unproved) {
        results["first_unproved"] = fmt::format("{}:{}", file, *certificate.first_unproved);
    }
    if (verdict.failure) {
        results["refused"] =
            fmt::format("{}:{}: {}", file, verdict.failure->line, verdict.failure->what);
    }
    results["verify_ms"] = percents.finish();
    results["proved"] = verdict.proved();
    return verdict.proved();
}

} // namespace

void write_certificate(
    const std::string& file, const CertifiedOrder& proved, bool quiet, base::JsonValue& results) {
    if (proved.model.polygons.empty()) {
        throw Error("--certificate: expected polygons that can be seen, got none");
    }
    write_file(file, certificate_text(proved, quiet, results));
    base::print_note(quiet, "certificate: " + file);
}

bool order_is_proved(const CertifiedOrder& proved, bool quiet, base::JsonValue& results) {
    if (proved.model.polygons.empty()) {
        return true;
    }
    const std::string text = certificate_text(proved, quiet, results);
    PercentProgress percents("verifying", quiet);
    return all_proofs_hold(proofs::certificate_of(text, "certificate"), percents, results);
}

bool verify_certificate(const std::string& file, bool quiet, base::JsonValue& results) {
    PercentProgress percents("verifying", quiet);
    const auto certificate = proofs::read_certificate(file);
    results["certificate"] = file;
    results["polygons"] = certificate.polygons.size();
    results["nodes"] = certificate.nodes.size();
    results["lists"] = certificate.lists.size();
    return all_proofs_hold(certificate, percents, results);
}

} // namespace octant::ui::commands
