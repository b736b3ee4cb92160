#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "tests/ui/world/user_cache.h"
#include "ui/world/order_folder.h"

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
    CHECK(world::order_folder("user") == folder / "octant" / "orders");
    CHECK(fs::is_directory(folder / "octant" / "orders"));
    CHECK(world::order_folder((folder / "mine").string()) == folder / "mine");
    CHECK(fs::is_directory(folder / "mine"));
    CHECK_FALSE(world::order_folder("none").has_value());
}

TEST_CASE("a user's cache that cannot be made is done without, a named folder is refused") {
    const fs::path folder = tests::empty_folder("order-folder-in-the-way");
    write_file(folder / "octant", "a file where the folder would be");
    const tests::UserCache cache(folder);
    CHECK_FALSE(world::order_folder("user").has_value());
    CHECK_THROWS_AS(world::order_folder((folder / "octant" / "orders").string()), Error);
}

TEST_CASE("what was written first goes until the rest is small enough") {
    const fs::path folder = tests::empty_folder("order-folder-full");
    const auto now = fs::file_time_type::clock::now();
    for (const int age : {3, 1, 2}) {
        const fs::path file = folder / std::to_string(age);
        write_file(file, std::string(100, 'x'));
        fs::last_write_time(file, now - std::chrono::hours(age));
    }
    world::remove_oldest(folder, 250);
    CHECK(fs::exists(folder / "1"));
    CHECK(fs::exists(folder / "2"));
    CHECK_FALSE(fs::exists(folder / "3"));
    world::remove_oldest(folder, 250);
    CHECK(fs::exists(folder / "2"));
}
