#include "scenes/load.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "scenes/bunny_box.h"
#include "scenes/gltf.h"

namespace macula {

Expected<LoadedScene> load_scene(const std::string& name_or_path) {
    if (name_or_path == "bunny-box") return make_bunny_box();
    std::string extension = std::filesystem::path(name_or_path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".gltf" || extension == ".glb") return load_gltf(name_or_path);
    return fail(ErrorCode::option,
                "unknown scene \"" + name_or_path + "\"; known are bunny-box and paths that end in .gltf or .glb");
}

}  // namespace macula
