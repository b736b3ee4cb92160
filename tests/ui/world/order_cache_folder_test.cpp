#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "tests/ui/world/user_cache.h"
#include "ui/world/aircraft_loader.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>
#include <string>

using namespace octant;
namespace fs = std::filesystem;
namespace world = octant::ui::world;

TEST_CASE("orders are kept in the user's cache, in a named folder or not at all") {
    const fs::path folder = tests::empty_folder("order-folder");
    const tests::UserCache cache(folder);
    CHECK(world::order_cache_folder("user") == folder / "octant" / "orders");
    CHECK(fs::is_directory(folder / "octant" / "orders"));
    CHECK(world::order_cache_folder((folder / "mine").string()) == folder / "mine");
    CHECK(fs::is_directory(folder / "mine"));
    CHECK_FALSE(world::order_cache_folder("none").has_value());
}

TEST_CASE("a user's cache that cannot be made is done without, a named folder is refused") {
    const fs::path folder = tests::empty_folder("order-folder-in-the-way");
    write_file(folder / "octant", "a file where the folder would be");
    const tests::UserCache cache(folder);
    CHECK_FALSE(world::order_cache_folder("user").has_value());
    CHECK_THROWS_AS(world::order_cache_folder((folder / "octant" / "orders").string()), Error);
}

TEST_CASE("what was written first goes until the rest is small enough, and nothing of others") {
    const fs::path folder = tests::empty_folder("order-folder-full");
    const auto now = fs::file_time_type::clock::now();
    const auto put = [&](const std::string& name, std::size_t bytes, int age_hours) {
        write_file(folder / name, std::string(bytes, 'x'));
        fs::last_write_time(folder / name, now - std::chrono::hours(age_hours));
    };
    put("3.order", 100, 3);
    put("1.order", 100, 1);
    put("2.pm", 100, 2);
    put("film.part", 1000, 9);
    put("letter.txt", 1000, 9);       // not of the cache
    put(".octant-1-0.part", 1000, 0); // another run is writing it
    put(".octant-1-1.part", 10, 9);   // left by a run that was killed
    fs::create_directory(folder / "folder.order");
    world::remove_oldest(folder, 250);
    CHECK(fs::exists(folder / "1.order"));
    CHECK(fs::exists(folder / "2.pm"));
    CHECK_FALSE(fs::exists(folder / "3.order"));
    world::remove_oldest(folder, 205);
    CHECK(fs::exists(folder / "2.pm"));
    CHECK_FALSE(fs::exists(folder / ".octant-1-1.part"));
    put("0.pm", 300, 0); // alone is too large: the others stay
    world::remove_oldest(folder, 250);
    CHECK_FALSE(fs::exists(folder / "0.pm"));
    CHECK(fs::exists(folder / "1.order"));
    CHECK(fs::exists(folder / "letter.txt"));
    CHECK(fs::exists(folder / "film.part"));
    CHECK(fs::exists(folder / ".octant-1-0.part"));
    CHECK(fs::exists(folder / "folder.order"));
}
