// octant-verify FILE: checks a certificate of a painting order with exact arithmetic (visuals/verify). It shares no
// code with what finds orders and writes certificates.
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/verify.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace {

namespace verify = octant::visuals::verify;

constexpr const char* help =
    R"(Checks a certificate of a painting order with exact arithmetic.
Usage: octant-verify [OPTIONS] FILE [MODEL]

  FILE        certificate that octant draw-order --certificate wrote
  MODEL       compare first that the certificate is of this model (octant draw-order MODEL --verify FILE)
  --json      print the results as JSON
  --quiet     print no progress; this program prints none
  --version   print the version
  --help      print this help

Exit code 0: every pair of polygons is proved. 1: a statement is false, missing or not proved. 2: not a certificate.
Example:
  octant draw-order f15 --certificate f15-proof.txt
  octant verify f15-proof.txt
  octant verify f15-proof.txt f15
)";

struct Arguments {
    std::string file;
    std::string model; ///< empty: none
    bool json = false;
    bool help = false;
    bool version = false;
};

/// Throws Error for an unknown option and for another number of files than one.
Arguments arguments_from(const std::vector<std::string>& words) {
    Arguments arguments;
    for (const std::string& word : words) {
        if (word == "--json") {
            arguments.json = true;
        } else if (word == "--help" || word == "-h") {
            arguments.help = true;
        } else if (word == "--version") {
            arguments.version = true;
        } else if (word.starts_with('-') && word != "--quiet") {
            throw octant::Error(
                fmt::format("expected --json, --quiet, --version or --help, got '{}'", octant::printable(word)));
        } else if (word != "--quiet") {
            if (!arguments.model.empty()) {
                throw octant::Error(fmt::format("expected one model, got a second one '{}'", octant::printable(word)));
            }
            (arguments.file.empty() ? arguments.file : arguments.model) = word;
        }
    }
    if (arguments.file.empty() && !arguments.help && !arguments.version) {
        throw octant::Error("FILE: expected a certificate, got none");
    }
    return arguments;
}

/// What a certificate is of, and how much it has.
struct Contents {
    std::string model;
    std::string model_hash;
    std::size_t polygons = 0;
    std::size_t nodes = 0;
    std::size_t lists = 0;
};

/// One result; `is_text` says that its value stands in quotation marks in JSON.
struct Result {
    std::string name;
    std::string value;
    bool is_text = false;
};

std::vector<Result> results_of(
    const std::string& file, const Contents& certificate, const verify::VerificationResult& verification) {
    const auto number = [](const auto& value) { return fmt::format("{}", value); };
    std::vector<Result> results{{"certificate", file, true}, {"model", certificate.model, true},
        {"model_hash", certificate.model_hash, true}, {"polygons", number(certificate.polygons)},
        {"nodes", number(certificate.nodes)}, {"lists", number(certificate.lists)},
        {"tolerance_sizes", number(verification.tolerance_sizes)}, {"pairs", number(verification.pairs)},
        {"pairs_by_partings", number(verification.by_node_planes)},
        {"claims_by_polygons", number(verification.statements.by_polygons)},
        {"claims_by_sums", number(verification.statements.by_sums)},
        {"claims_never_seen", number(verification.statements.never_both_visible)},
        {"unlisted", number(verification.unlisted)}, {"unproved", number(verification.unproved)},
        {"every_eye", number(verification.covers_every_eye)}};
    if (verification.first_unproved) {
        results.push_back({"first_unproved", fmt::format("{}:{}", file, *verification.first_unproved), true});
    }
    if (verification.failure) {
        results.push_back(
            {"refused", fmt::format("{}:{}: {}", file, verification.failure->line, verification.failure->what), true});
    }
    results.push_back({"proved", number(verification.proved())});
    return results;
}

std::string json_string(const std::string& text) {
    std::string quoted = "\"";
    for (const char letter : octant::one_line(text)) {
        if (letter == '"' || letter == '\\') { quoted += '\\'; }
        quoted += letter;
    }
    return quoted + '"';
}

void print(const std::vector<Result>& results, bool json) {
    std::size_t width = 0;
    for (const Result& result : results) { width = std::max(width, result.name.size()); }
    std::string text;
    for (const auto& [name, value, is_text] : results) {
        text += json ? fmt::format(
                           "{}  \"{}\": {}", text.empty() ? "{\n" : ",\n", name, is_text ? json_string(value) : value)
                     : fmt::format("{:<{}}  {}\n", name, width, octant::one_line(value));
    }
    std::fputs((json ? text + "\n}\n" : text).c_str(), stdout);
}

/// Lets octant read the model, which calls this program again.
[[noreturn]] void compare_model(const Arguments& arguments) {
    std::error_code ignored;
    const auto folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    const std::string program = (folder / "octant").string();
    std::vector<std::string> words{
        program, "draw-order", arguments.model, "--verify", arguments.file, arguments.json ? "--json" : "--quiet"};
    std::vector<char*> pointers;
    for (std::string& word : words) { pointers.push_back(word.data()); }
    pointers.push_back(nullptr);
    execv(program.c_str(), pointers.data());
    throw octant::Error(fmt::format("{}: expected the program that reads models, got none", program));
}

int run(const std::vector<std::string>& words) {
    const Arguments arguments = arguments_from(words);
    if (arguments.help || arguments.version) {
        std::fputs(arguments.help ? help : "octant-verify " OCTANT_VERSION "\n", stdout);
        return 0;
    }
    verify::CertificateReader reader(arguments.file); // first: whoever swaps FILE and MODEL is told of FILE
    if (!arguments.model.empty()) { compare_model(arguments); }
    const verify::Certificate& read = reader.certificate();
    const Contents contents{read.model, read.model_hash, read.polygons.size(), read.nodes.size(), read.lists.size()};
    const verify::VerificationResult verification = verify::verify(std::move(reader));
    print(results_of(arguments.file, contents, verification), arguments.json);
    return verification.proved() ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const std::exception& fault) {
        std::fputs(fmt::format("octant-verify: {}\n", octant::one_line(fault.what())).c_str(), stderr);
        return 2;
    }
}
