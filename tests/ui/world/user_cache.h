#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace octant::tests {

/// Sets the folder of the user's caches as long as this lives.
class UserCache {
public:
    explicit UserCache(const std::filesystem::path& folder) {
        if (const char* before = std::getenv(variable)) { before_ = before; }
        ::setenv(variable, folder.c_str(), 1);
    }

    ~UserCache() { ::setenv(variable, before_.c_str(), 1); }

    UserCache(const UserCache&) = delete;
    UserCache& operator=(const UserCache&) = delete;
    UserCache(UserCache&&) = delete;
    UserCache& operator=(UserCache&&) = delete;

private:
    static constexpr const char* variable = "XDG_CACHE_HOME";
    std::string before_; ///< Empty is as good as none.
};

} // namespace octant::tests
