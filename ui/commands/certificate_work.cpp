#include "ui/commands/certificate_work.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/commands/percents.h"
#include "visuals/certificate/order_certificate.h"
#include "visuals/verify/certificate_reader.h"
#include "visuals/verify/verify.h"

#include <fmt/format.h>

namespace octant::ui::commands {

namespace {

namespace proofs = visuals::verify;

std::string certificate_text(const ProvedOrder& proved, bool quiet, base::Figures& figures) {
    Percents percents("seeking proofs", quiet);
    const auto certificate = visuals::certificate::order_certificate(
        proved.model, proved.order, proved.axes, [&](std::size_t done, std::size_t all) {
            percents.show(static_cast<double>(done) / static_cast<double>(all));
        });
    figures["certificate_ms"] = percents.finish();
    figures["certificate_unproved"] = certificate.unproved;
    return certificate.text;
}

/// Checks a certificate without rounding and adds to the figures; whether it proves all.
bool all_holds(const proofs::Certificate& certificate, Percents& percents, base::Figures& figures) {
    const std::string file = certificate.path.string();
    const auto verdict = proofs::verify(certificate, [&](std::size_t done, std::size_t all) {
        percents.show(static_cast<double>(done) / static_cast<double>(all));
    });
    figures["tolerance_sizes"] = verdict.tolerance_sizes;
    figures["pairs"] = verdict.pairs;
    figures["pairs_by_partings"] = verdict.by_partings;
    figures["claims_by_polygons"] = verdict.claims.by_polygons;
    figures["claims_by_sums"] = verdict.claims.by_sums;
    figures["claims_never_seen"] = verdict.claims.never_seen;
    figures["unlisted"] = verdict.unlisted;
    figures["unproved"] = verdict.unproved;
    figures["every_eye"] = verdict.every_eye;
    if (certificate.first_unproved) {
        figures["first_unproved"] = fmt::format("{}:{}", file, *certificate.first_unproved);
    }
    if (verdict.refused) {
        figures["refused"] =
            fmt::format("{}:{}: {}", file, verdict.refused->line, verdict.refused->what);
    }
    figures["verify_ms"] = percents.finish();
    figures["proved"] = verdict.proved();
    return verdict.proved();
}

} // namespace

void write_certificate(
    const std::string& file, const ProvedOrder& proved, bool quiet, base::Figures& figures) {
    if (proved.model.polygons.empty()) {
        throw Error("--certificate: expected polygons that can be seen, got none");
    }
    write_file(file, certificate_text(proved, quiet, figures));
    base::say(quiet, "certificate: " + file);
}

bool is_proved(const ProvedOrder& proved, bool quiet, base::Figures& figures) {
    if (proved.model.polygons.empty()) {
        return true;
    }
    const std::string text = certificate_text(proved, quiet, figures);
    Percents percents("verifying", quiet);
    return all_holds(proofs::certificate_of(text, "certificate"), percents, figures);
}

bool verified(const std::string& file, bool quiet, base::Figures& figures) {
    Percents percents("verifying", quiet);
    const auto certificate = proofs::read_certificate(file);
    figures["certificate"] = file;
    figures["polygons"] = certificate.polygons.size();
    figures["nodes"] = certificate.nodes.size();
    figures["lists"] = certificate.lists.size();
    return all_holds(certificate, percents, figures);
}

} // namespace octant::ui::commands
