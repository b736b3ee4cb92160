#include "tests/fuzz/trial.h"

#include "models/polygons/obj_reader.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/fuzz/painting_check.h"
#include "tests/scratch.h"
#include "visuals/certificate/order_certificate.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/verify.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace octant::tests::fuzz {

namespace {

/// What a child sends to its parent, in one write.
struct Report {
    Outcome outcome = Outcome::Right;
    std::array<long, 6> counts{};
    double build_s = 0.0;
    std::array<char, 400> what{};
};

Outcome outcome_of(const PaintingCounts& counts) {
    if (counts.bad_sequences > 0) { return Outcome::BadSequence; }
    if (counts.wrong_order > 0) { return Outcome::WrongOrder; }
    if (counts.wrong_picture > 0) { return Outcome::WrongPicture; }
    return counts.wrong_decal > 0 ? Outcome::WrongDecal : Outcome::Right;
}

void set_what(Report& report, const std::string& what) {
    std::strncpy(report.what.data(), what.c_str(), report.what.size() - 1);
}

/// Why a model's order is not proved right; empty if it is.
std::string gap_in_proof(const visuals::draworder::OrderedModel& ordered) {
    const std::filesystem::path file = scratch_folder() / "certificate.txt";
    write_file(file, visuals::certificate::order_certificate({ordered.model, ordered.order, {}, {"trial", "0"}}).text);
    const auto verdict = visuals::verify::verify(visuals::verify::CertificateReader(file));
    if (verdict.failure) { return fmt::format("line {}: {}", verdict.failure->line, verdict.failure->what); }
    return verdict.proved() ? "" : fmt::format("{} claims without proof", verdict.unproved);
}

Report order_and_check(const std::filesystem::path& file, const TrialOptions& options) {
    Report report;
    try {
        const auto given = models::polygons::read_obj(file);
        const auto begin = std::chrono::steady_clock::now();
        visuals::draworder::OrderOptions order;
        order.seconds = options.order_s;
        const auto ordered = visuals::draworder::ordered(given, order);
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
        const PaintingCounts counts = check_painting(given, ordered, {options.rays, options.seed});
        report.outcome = outcome_of(counts);
        report.counts = {long(given.polygons.size()), long(ordered.model.polygons.size()),
            long(ordered.order.cell_count()), counts.hits, counts.open,
            counts.wrong_order + counts.wrong_picture + counts.wrong_decal};
        report.build_s = spent.count();
        set_what(report, counts.first);
        if (options.certify && report.outcome == Outcome::Right) {
            const std::string gap = gap_in_proof(ordered);
            report.outcome = gap.empty() ? Outcome::Right : Outcome::NotProved;
            set_what(report, gap);
        }
    } catch (const Error& error) {
        report.outcome = Outcome::Refused;
        set_what(report, error.what());
    } catch (const std::exception& error) {
        report.outcome = Outcome::Abort;
        set_what(report, error.what());
    }
    return report;
}

void limit_to(int cpu_s) {
    const auto seconds = static_cast<rlim_t>(cpu_s);
    const rlimit cpu{seconds, seconds + 2};
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CPU, &cpu);
    setrlimit(RLIMIT_CORE, &none);
}

[[noreturn]] void be_child(int pipe_end, const std::filesystem::path& file, const TrialOptions& options) {
    limit_to(options.cpu_s);
    const Report report = order_and_check(file, options);
    const bool sent = write(pipe_end, &report, sizeof report) == ssize_t(sizeof report);
    _exit(sent ? 0 : 1);
}

TrialResult result_of(const Report& report) {
    const auto& counts = report.counts;
    return {.outcome = report.outcome,
        .polygons = counts[0],
        .pieces = counts[1],
        .cells = counts[2],
        .build_s = report.build_s,
        .hits = counts[3],
        .open = counts[4],
        .wrong = counts[5],
        .what = report.what.data()};
}

TrialResult result_of_end(int status, const ObjPolygons& model) {
    TrialResult result;
    result.polygons = static_cast<long>(model.polygons.size());
    const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (number == SIGXCPU || number == SIGKILL) {
        result.outcome = Outcome::Timeout;
        result.what = "used up its CPU seconds";
    } else {
        result.outcome = number == SIGABRT ? Outcome::Abort : Outcome::Crash;
        result.what = number == 0 ? "ended without a report" : fmt::format("signal {} ({})", number, strsignal(number));
    }
    return result;
}

} // namespace

TrialResult tried(const ObjPolygons& model, const TrialOptions& options) {
    const std::filesystem::path file = scratch_folder() / "model.obj";
    write_file(file, text_of(model, "a trial of the fuzzer"));
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) { throw Error("expected a pipe to a child process, got none"); }
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        be_child(ends[1], file, options);
    }
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        throw Error("expected a child process, got none");
    }
    Report report;
    const bool reported = read(ends[0], &report, sizeof report) == ssize_t(sizeof report);
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    const bool ended_well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return reported && ended_well ? result_of(report) : result_of_end(status, model);
}

} // namespace octant::tests::fuzz
