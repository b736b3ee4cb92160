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

void write_certificate(
    const std::string& file,
    const models::polygons::PolygonModel& model,
    const visuals::draworder::DrawOrder& order,
    const models::polygons::FileAxes& axes,
    bool quiet,
    base::Figures& figures) {
    if (model.polygons.empty()) {
        throw Error("--certificate: expected polygons that can be seen, got none");
    }
    Percents percents("seeking proofs", quiet);
    const auto certificate = visuals::certificate::order_certificate(
        model, order, axes, [&](std::size_t done, std::size_t all) {
            percents.show(static_cast<double>(done) / static_cast<double>(all));
        });
    figures["certificate_ms"] = percents.finish();
    figures["certificate_unproved"] = certificate.unproved;
    write_file(file, certificate.text);
    base::say(quiet, "certificate: " + file);
}

bool verified(const std::string& file, bool quiet, base::Figures& figures) {
    Percents percents("verifying", quiet);
    const auto certificate = visuals::verify::read_certificate(file);
    const auto verdict =
        visuals::verify::verify(certificate, [&](std::size_t done, std::size_t all) {
            percents.show(static_cast<double>(done) / static_cast<double>(all));
        });
    figures["certificate"] = file;
    figures["polygons"] = certificate.polygons.size();
    figures["nodes"] = certificate.nodes.size();
    figures["lists"] = certificate.lists.size();
    figures["tolerance_sizes"] = verdict.tolerance_sizes;
    figures["pairs"] = verdict.pairs;
    figures["pairs_by_partings"] = verdict.by_partings;
    figures["claims_by_polygons"] = verdict.claims.by_polygons;
    figures["claims_by_sums"] = verdict.claims.by_sums;
    figures["claims_never_seen"] = verdict.claims.never_seen;
    figures["unlisted"] = verdict.unlisted;
    figures["unproved"] = verdict.unproved;
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

} // namespace octant::ui::commands
