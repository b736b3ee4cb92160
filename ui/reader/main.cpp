// octant-read-mesh LIBRARY PICTURES BACKS IN OUT.obj: reads a mesh by a library and writes it as OBJ, which holds all
// of it; with LIBRARY "draco" writes a glTF file unpacked, as OUT.glb. PICTURES is "textures", "pictures" or "-", BACKS
// "backs" or "-". It is a separate program because a file may make the library crash, hang or use all memory.
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/texture_store.h"
#include "sim/base/error.h"
#include "ui/reader/library_readers.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>

using namespace octant;

namespace {

constexpr int exit_invalid_input = 2;
constexpr rlim_t max_bytes = rlim_t{4} << 30U;
constexpr rlim_t max_file_bytes = rlim_t{2} << 30U;
constexpr rlim_t max_cpu_s = 25;
constexpr unsigned max_s = 60;

// The address sanitizer reserves terabytes of addresses, which no limit may stand in the way of.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool limits_memory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool limits_memory = false;
#else
constexpr bool limits_memory = true;
#endif
#else
constexpr bool limits_memory = true;
#endif

void limit() {
    const rlimit memory{max_bytes, max_bytes};
    const rlimit cpu{max_cpu_s, max_cpu_s};
    const rlimit core{0, 0};
    const rlimit file{max_file_bytes, max_file_bytes};
    if (limits_memory) { setrlimit(RLIMIT_AS, &memory); }
    setrlimit(RLIMIT_CPU, &cpu);
    setrlimit(RLIMIT_CORE, &core);
    setrlimit(RLIMIT_FSIZE, &file);
    std::signal(SIGXFSZ, SIG_IGN); // a write beyond the limit fails, and is told
    alarm(max_s);
}

void read(const std::string& library, const models::meshfile::ReadOptions& options, const std::string& in,
    const std::string& out) {
    if (library == "draco") {
#if defined(OCTANT_HAS_DRACO)
        ui::reader::unpack_draco(in, out);
        return;
#else
        throw Error(in + ": expected a build with Draco (libdraco-dev), got one without; gltf-transform or Blender "
                         "write the file unpacked");
#endif
    }
    models::meshfile::MeshBuilder mesh(in, options);
    if (library == "assimp") {
        ui::reader::read_by_assimp(in, mesh);
    } else {
        ui::reader::read_by_osg(in, mesh);
    }
    models::TriangleMesh read = mesh.finish();
    if (read.colours_are_means) { read.colours.clear(); } // whoever reads the pictures makes them again
    models::meshfile::write_mesh(out, read);
}

} // namespace

int main(int count, char** words) {
    if (count != 6) {
        std::fputs(
            "octant-read-mesh assimp|osg|draco textures|pictures|- backs|- IN OUT.obj: started by octant\n", stderr);
        return exit_invalid_input;
    }
    limit();
    try {
        const std::string_view pictures = words[2];
        models::meshfile::ReadOptions options{
            .pictures = pictures != "-", .backs = std::string_view(words[3]) == "backs"};
        if (pictures == "textures") { options.textures = std::make_shared<models::meshfile::TextureStore>(); }
        read(words[1], options, words[4], words[5]);
        return 0;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s: expected a mesh that fits in 4 GiB, got a larger one\n", words[4]);
    } catch (const std::exception& fault) { std::fprintf(stderr, "%s\n", fault.what()); }
    return exit_invalid_input;
}
