#include "tests/ui/commands/documented_lines.h"

#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/flight/small_ground.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

namespace octant::tests {

namespace fs = std::filesystem;

namespace {

/// Adds the commands of one line, which ; and && part.
void add_commands(std::string_view line, std::vector<CommandLine>& lines) {
    CommandLine command;
    const auto end_command = [&] {
        if (!command.empty() && command.front() == "octant") {
            command.erase(command.begin());
            lines.push_back(command);
        }
        command.clear();
    };
    for (std::string_view word : split_words(line)) {
        if (word.starts_with('#')) { break; }
        const bool ends = word.ends_with(';') || word == "&&";
        if (word != "&&") { command.emplace_back(word.substr(0, word.size() - (word.ends_with(';') ? 1 : 0))); }
        if (ends) { end_command(); }
    }
    end_command();
}

/// Gives an option another word, or the option to a line that lacks it.
void set_option(CommandLine& line, const std::string& name, const std::string& word) {
    const auto found = std::ranges::find(line, name);
    if (found == line.end()) {
        line.insert(line.end(), {name, word});
    } else if (found + 1 != line.end()) {
        *(found + 1) = word;
    }
}

bool has(const CommandLine& line, std::string_view word) { return std::ranges::find(line, word) != line.end(); }

void run_or_throw(const CommandLine& line) {
    const ProgramRun run = run_octant(line);
    if (run.exit_code != 0) { throw std::runtime_error("an input cannot be made: " + run.err); }
}

/// A small input for each kind of file and a recording, made once.
const fs::path& seed_folder() {
    static const fs::path folder = [] {
        const fs::path made = empty_folder("documented-inputs");
        const auto file = [&](const char* name) { return (made / name).string(); };
        run_or_throw(shortened({"terrain", "make", "--out", file("seed.tif")}));
        for (const char* mesh : {"seed.ply", "seed.stl"}) {
            run_or_throw({"simplify", "torus", file(mesh), "--faces", "300", "--method", "fast"});
        }
        run_or_throw({"draw-order", "concave", "--export-model", file("seed.obj")});
        run_or_throw(shortened({"fly", "straight", "--record", file("recording")}));
        fs::copy_file(made / "recording" / "track.csv", made / "seed.csv");
        fs::copy_file(fs::path(OCTANT_SOURCE_DIR) / "flightpaths/f15-turn.toml", made / "seed.toml");
        return made;
    }();
    return folder;
}

void make_recording(const fs::path& folder) {
    if (!fs::exists(folder)) { fs::copy(seed_folder() / "recording", folder, fs::copy_options::recursive); }
}

/// Makes what a word names, which stands behind `option`.
void make_input(const std::string& option, const fs::path& file) {
    constexpr std::array outputs = {"--out", "--out-partition", "--export", "--export-model", "--save", "--nodes"};
    if (std::ranges::find(outputs, option) != outputs.end()) { return; }
    if (option == "--replay") {
        make_recording(file);
    } else if (file.filename() == "run.json") {
        make_recording(file.parent_path());
    } else if (fs::exists(file)) {
        return;
    } else if (option == "--eye-points") {
        write_file(file, "map,0,0,500,30,-10\n");
    } else if (file.native().ends_with('/')) {
        fs::create_directories(file);
        fs::copy_file(seed_folder() / "seed.tif", file / "seed.tif");
    } else if (const fs::path seed = seed_folder() / ("seed" + file.extension().string());
               file.has_extension() && fs::exists(seed)) {
        fs::copy_file(seed, file);
    }
}

} // namespace

std::vector<CommandLine> command_lines(std::string_view text) {
    std::vector<CommandLine> lines;
    for (const std::string_view line : split_lines(text)) { add_commands(line, lines); }
    return lines;
}

std::vector<CommandLine> command_lines_in_blocks(const fs::path& markdown) {
    std::vector<CommandLine> lines;
    const std::string text = read_text_file(markdown);
    bool in_block = false;
    for (const std::string_view line : split_lines(text)) {
        if (line.starts_with("```")) {
            in_block = !in_block;
        } else if (in_block) {
            add_commands(line, lines);
        }
    }
    return lines;
}

std::vector<fs::path> readme_files() {
    const fs::path root = OCTANT_SOURCE_DIR;
    std::vector<fs::path> files;
    for (const char* top : {"sim", "flightpaths", "models", "visuals", "ui", "tests"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            if (entry.path().filename() == "README.md") { files.push_back(entry.path()); }
        }
    }
    std::ranges::sort(files);
    files.insert(files.begin(), root / "README.md");
    return files;
}

CommandLine shortened(CommandLine line) {
    const std::string command = line.front() == "terrain" && line.size() > 1 ? "terrain " + line[1] : line.front();
    // Large enough for the paths that fly over them.
    static const std::map<std::string, std::vector<std::pair<std::string, std::string>>> quick = {
        {"fly", {{"--frames", "12"}, {"--size", "64x36"}}},
        {"terrain make", {{"--size", "129"}, {"--terrain-spacing", "160"}}}, {"terrain error", {{"--size", "64x36"}}},
        {"terrain check", {{"--views", "2"}}}, {"mesh-error", {{"--samples", "1000"}}}};
    const auto found = quick.find(command);
    if (found != quick.end() && !has(line, "--replay")) {
        for (const auto& [name, word] : found->second) { set_option(line, name, word); }
    }
    if (command == "fly" && !has(line, "--terrain") && !has(line, "--settings") && !has(line, "--replay")) {
        line.insert(line.end(), {"--terrain", small_ground()});
    }
    // Of one aircraft many lines fly: its order is found once.
    if (command == "fly" && !has(line, "--order-cache") && !has(line, "--replay")) {
        line.insert(line.end(), {"--order-cache", (scratch_folder() / "orders").string()});
    }
    if (has(line, "--check")) { set_option(line, "--rays", "1000"); }
    return line;
}

void make_inputs(const CommandLine& line) {
    for (std::size_t i = 1; i < line.size(); ++i) {
        const bool is_option = line[i].starts_with("--");
        if (line.front() == "report" && !is_option && !line[i - 1].starts_with("--")) {
            make_recording(line[i]);
        } else if (!is_option) {
            make_input(line[i - 1], line[i]);
        }
    }
}

} // namespace octant::tests
