#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "scenes/gltf.h"
#include "tests/support/scene_defect.h"

/// Any bytes: the loader answers with a scene that keeps every promise, or with an error that names the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const macula::GltfLimits limits{.file_bytes = std::size_t{1} << 24U,
                                    .elements = std::size_t{1} << 16U,
                                    .texels = std::size_t{1} << 18U,
                                    .image_side_px = 1024,
                                    .instances = 4096};
    const auto loaded = macula::load_gltf_from_memory(std::span(data, size), "fuzz", limits);
    if (loaded) {
        if (!macula::scene_defect(*loaded->scene).empty()) std::abort();
    } else if (loaded.error().code != macula::ErrorCode::input_file || loaded.error().message.rfind("fuzz: ", 0) != 0) {
        std::abort();
    }
    return 0;
}
