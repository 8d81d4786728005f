#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "masks/mesh/mesh_file.h"
#include "masks/mesh/mesh_quality.h"

/// Any bytes: the reader answers with a mesh that keeps every promise, or with an error that names the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto mesh = macula::read_mesh_from_memory(std::span(data, size), "fuzz");
    if (mesh) {
        const auto covered = std::int64_t{2} * (mesh->width_px - 1) * (mesh->height_px - 1);
        if (macula::triangle_quality(*mesh).doubled_area_px2 != covered) std::abort();
    } else if (mesh.error().code != macula::ErrorCode::input_file || mesh.error().message.rfind("fuzz: ", 0) != 0) {
        std::abort();
    }
    return 0;
}
