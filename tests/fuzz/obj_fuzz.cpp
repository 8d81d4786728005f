#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "scenes/obj.h"

/// Any bytes: the reader answers with a mesh whose triangles and attributes fit together, or with an error that names
/// the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream file(std::string(reinterpret_cast<const char*>(data), size));
    const auto mesh = macula::parse_obj(file, "fuzz.obj");
    if (!mesh) {
        if (mesh.error().code != macula::ErrorCode::input_file) std::abort();
        if (mesh.error().message.find("fuzz.obj") == std::string::npos) std::abort();
        return 0;
    }
    const std::size_t vertices = mesh->position_m.size();
    if (mesh->triangle.empty() || mesh->normal.size() != vertices) std::abort();
    if (!mesh->uv0.empty() && mesh->uv0.size() != vertices) std::abort();
    for (const glm::uvec3& triangle : mesh->triangle) {
        if (triangle.x >= vertices || triangle.y >= vertices || triangle.z >= vertices) std::abort();
    }
    return 0;
}
