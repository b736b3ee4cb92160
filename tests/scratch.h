#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace octant::tests {

/// A folder of this process's own, removed when the process ends: tests run side by side.
inline std::filesystem::path scratch_folder() {
    struct Folder {
        std::filesystem::path path =
            std::filesystem::temp_directory_path() / ("octant-test-" + std::to_string(getpid()));

        Folder() { std::filesystem::create_directories(path); }

        ~Folder() {
            std::error_code ignored;
            std::filesystem::remove_all(path, ignored);
        }

        Folder(const Folder&) = delete;
        Folder& operator=(const Folder&) = delete;
        Folder(Folder&&) = delete;
        Folder& operator=(Folder&&) = delete;
    };

    static const Folder folder;
    return folder.path;
}

/// An empty folder for one test, removed and made anew.
inline std::filesystem::path empty_folder(const std::string& name) {
    const std::filesystem::path folder = scratch_folder() / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

/// A path in the scratch folder; a file of that name is removed first.
inline std::filesystem::path scratch_file(const std::string& name) {
    std::filesystem::create_directories(scratch_folder()); // a test may have removed it
    std::filesystem::remove_all(scratch_folder() / name);
    return scratch_folder() / name;
}

/// While it lives, programs are looked for in `path` only.
class SearchPath {
public:
    explicit SearchPath(const std::string& path) : before_(std::getenv("PATH") != nullptr ? std::getenv("PATH") : "") {
        setenv("PATH", path.c_str(), 1);
    }

    ~SearchPath() { setenv("PATH", before_.c_str(), 1); }

    SearchPath(const SearchPath&) = delete;
    SearchPath& operator=(const SearchPath&) = delete;
    SearchPath(SearchPath&&) = delete;
    SearchPath& operator=(SearchPath&&) = delete;

private:
    std::string before_;
};

/// Makes a program of that name in `folder` which runs `script`.
inline void make_program(const std::filesystem::path& folder, const std::string& name, const std::string& script) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / name) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
}

} // namespace octant::tests
