#include "tests/fuzz/formats/target.h"
#include "ui/sweep/sweep_file.h"

#include <set>

namespace octant::tests::formats::sweep_format {

namespace {

/// Every flight has a name of its own that can be a file's.
void use(const std::filesystem::path& file) {
    const ui::sweep::Sweep sweep = ui::sweep::read_sweep(file);
    expect(!sweep.runs.empty() && sweep.runs.size() <= ui::sweep::max_runs, "as many as may be");
    std::set<std::string> names;
    for (const ui::sweep::SweepRun& run : sweep.runs) {
        expect(!run.name.empty() && run.name.front() != '.' && run.name.find('/') == std::string::npos,
            "a name that a file can have");
        expect(names.insert(run.name).second, "a name of its own");
    }
}

constexpr const char* lists = R"(name = "budgets"
repeats = 2
[settings]
size = "64x48"
terrain = "none"
[vary]
path = ["straight", "turn"]
aircraft = ["f15", ["f15", "500md"]]
triangles = { from = 2000, to = 6000, step = 2000 }
)";

constexpr const char* groups = R"([settings]
path = "jinking"
[vary]
fov = { from = 40, to = 60, step = 10 }
[vary.order.paper]
order-method = "paper"
[vary.order.tree]
order-method = "tree"
samples = 4
)";

const Registered target({
    .name = "sweep",
    .file = "input.toml",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{lists, groups};
        },
    .words = {"[settings]\n", "[vary]\n", "[vary.a.b]\n", "repeats = ", "{ from = 1, to = 9, step = 2 }", "step = 0",
        "step = -1", "to = 1e18", "\"../x\"", "\".\"", "[[1]]", "path = [\"turn\"]\n", "nan", "inf", "true", "'''"},
});

} // namespace

} // namespace octant::tests::formats::sweep_format
