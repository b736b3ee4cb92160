#include "tests/fuzz/formats/target.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <fstream>
#include <unistd.h>
#include <utility>

namespace octant::tests::formats {

namespace {

std::vector<Target>& all_targets() {
    static std::vector<Target> all;
    return all;
}

/// In memory where that can be: a disk's file system brings each file that is emptied and written again to the disk at
/// once.
class InputFolder {
public:
    InputFolder() {
        const std::filesystem::path in_memory = "/dev/shm";
        path_ = ::access(in_memory.c_str(), W_OK) == 0 ? in_memory : std::filesystem::temp_directory_path();
        path_ /= "octant-formats-" + std::to_string(::getpid());
        make_folder(path_);
    }

    ~InputFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    InputFolder(InputFolder&&) = delete;
    InputFolder& operator=(InputFolder&&) = delete;
    InputFolder(const InputFolder&) = delete;
    InputFolder& operator=(const InputFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

void check_message(const std::filesystem::path& folder, const std::string& message) {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    expect(message.size() > 10, "a message of a few words, got \"" + message + "\"");
    expect(message.size() < 2000, "a short message, got " + message);
    expect(std::ranges::none_of(message, is_control), "one line of text, got " + message);
    expect(message.starts_with(folder.string()), "a message that names the file, got " + message);
}

std::string use_file(const Target& target, const std::filesystem::path& file, std::string_view bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    try {
        target.use(file);
    } catch (const Error& refusal) {
        check_message(file.parent_path(), refusal.what());
        return refusal.what();
    }
    return {};
}

} // namespace

void expect(bool so, const std::string& otherwise) {
    if (!so) { throw Finding("expected " + otherwise); }
}

Registered::Registered(Target target) {
    std::vector<Target>& all = all_targets();
    const auto place = std::ranges::lower_bound(all, target.name, {}, &Target::name);
    all.insert(place, std::move(target));
}

std::span<const Target> targets() { return all_targets(); }

const std::filesystem::path& input_folder() {
    static const InputFolder folder;
    return folder.path();
}

std::string tried(const Target& target, std::string_view bytes) {
    if (target.decode) {
        const auto all = std::as_bytes(std::span(bytes));
        target.decode(std::vector<std::byte>(all.begin(), all.end()));
        return {};
    }
    const std::filesystem::path file = input_folder() / target.file;
    std::string refusal = use_file(target, file, bytes);
    if (target.seal) {
        std::string sealed(bytes);
        target.seal(sealed);
        if (sealed != bytes) { refusal = use_file(target, file, sealed); }
    }
    return refusal;
}

std::string bytes_written(
    const std::string& name, const std::function<void(const std::filesystem::path& file)>& write) {
    const std::filesystem::path file = input_folder() / name;
    write(file);
    return read_file(file);
}

} // namespace octant::tests::formats
