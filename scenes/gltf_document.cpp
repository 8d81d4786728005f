#include "scenes/gltf_document.h"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "protocol/base/glb.h"

namespace macula {
namespace {

constexpr std::array<std::string_view, 12> kSupportedExtensions = {
    "EXT_texture_webp",    "KHR_lights_punctual",  "KHR_materials_clearcoat", "KHR_materials_emissive_strength",
    "KHR_materials_ior",   "KHR_materials_sheen",  "KHR_materials_specular",  "KHR_materials_transmission",
    "KHR_materials_unlit", "KHR_materials_volume", "KHR_mesh_quantization",   "KHR_texture_transform"};

/// What tinygltf's file callbacks may do.
struct FileAccess {
    std::string folder;  ///< with a slash at its end; empty: no files at all
    std::size_t max_bytes = 0;
    std::string refusal;  ///< why the last uri was not followed
};

/// Whether `path`, as tinygltf joins it from folder and uri, is a relative uri that stays below the folder.
bool allowed(FileAccess& access, const std::string& path) {
    // tinygltf also looks below the current directory, which is nobody's business.
    if (access.folder.empty() || path.compare(0, access.folder.size(), access.folder) != 0) return false;
    const std::filesystem::path relative(path.substr(access.folder.size()));
    if (relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end()) {
        access.refusal = "the uri \"" + relative.string() + "\" leaves the folder of the file";
        return false;
    }
    return true;
}

bool file_exists(const std::string& path, void* access) {
    std::error_code error;
    return allowed(*static_cast<FileAccess*>(access), path) && std::filesystem::is_regular_file(path, error);
}

std::string expand_file_path(const std::string& path, void* /*access*/) {
    return path;
}

bool read_whole_file(std::vector<unsigned char>* out, std::string* error, const std::string& path, void* access) {
    auto& files = *static_cast<FileAccess*>(access);
    if (!allowed(files, path)) return false;
    Expected<std::vector<std::uint8_t>> bytes = read_file(path, files.max_bytes);
    if (!bytes) {
        *error = bytes.error().message;
        return false;
    }
    *out = std::move(*bytes);
    return true;
}

/// tinygltf's image callback: keeps the encoded bytes, which are decoded when a material uses them.
/// Bytes of buffer views are not touched: tinygltf has not checked them.
bool keep_image(tinygltf::Image* image, int index, std::string* /*error*/, std::string* /*warning*/, int /*width*/,
                int /*height*/, const unsigned char* bytes, int size, void* user) {
    auto& kept = *static_cast<std::vector<std::vector<std::uint8_t>>*>(user);
    kept.resize(std::max(kept.size(), static_cast<std::size_t>(index) + 1));
    if (image->bufferView < 0 && size > 0) kept[static_cast<std::size_t>(index)].assign(bytes, bytes + size);
    return true;
}

/// What tinygltf demands and glTF does not: matrices of skins, which we do not read, and nodes of animation channels
/// that an extension points elsewhere.
constexpr std::array<std::string_view, 3> kNoComplaints = {"'inverseBindMatrices' property is missing",
                                                           "'node' property is missing",
                                                           "`node` field is missing in animation.channels.target"};

/// tinygltf's complaints as one sentence; empty if there are none that count.
std::string complaints(const std::string& lines) {
    std::istringstream stream(lines);
    std::string all;
    for (std::string line; std::getline(stream, line);) {
        const bool counts = std::none_of(kNoComplaints.begin(), kNoComplaints.end(), [&line](std::string_view text) {
            return line.find(text) != std::string::npos;
        });
        if (!line.empty() && counts) all += (all.empty() ? "" : "; ") + line;
    }
    return all;
}

std::string unknown_required_extensions(const tinygltf::Model& model) {
    std::string names;
    for (const std::string& name : model.extensionsRequired)
        if (!is_supported_extension(name)) names += (names.empty() ? "" : ", ") + name;
    return names;
}

}  // namespace

std::string element_name(const char* kind, std::size_t index, const std::string& name) {
    return std::string(kind) + " " + std::to_string(index) + (name.empty() ? "" : " (\"" + name + "\")");
}

bool is_supported_extension(const std::string& name) {
    return std::find(kSupportedExtensions.begin(), kSupportedExtensions.end(), name) != kSupportedExtensions.end();
}

Expected<std::vector<std::uint8_t>> read_file(const std::string& path, std::size_t max_bytes) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return fail(ErrorCode::input_file, "cannot open " + path);
    const std::streamoff size = file.tellg();
    if (size < 0) return fail(ErrorCode::input_file, "cannot read " + path);
    if (static_cast<std::uint64_t>(size) > max_bytes)
        return fail(ErrorCode::input_file, path + " is larger than " + std::to_string(max_bytes) + " bytes");
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(bytes.data()), size);
    if (!file) return fail(ErrorCode::input_file, "cannot read " + path);
    return bytes;
}

Expected<GltfDocument> read_gltf_document(std::span<const std::uint8_t> bytes, const std::string& name,
                                          const std::string& folder, const GltfLimits& limits) {
    const auto refuse = [&name](const std::string& what) { return fail(ErrorCode::input_file, name + ": " + what); };
    if (bytes.size() > limits.file_bytes) return refuse("larger than " + std::to_string(limits.file_bytes) + " bytes");
    std::string_view json(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (is_glb(bytes)) {
        const Expected<std::string_view> chunk = glb_json(bytes);
        if (!chunk) return refuse(chunk.error().message);
        json = *chunk;
    }
    if (json_depth(json) > kMaxJsonDepth) return refuse("the JSON is nested too deeply");

    GltfDocument document;
    document.name = name;
    FileAccess access{folder.empty() || folder.back() == '/' ? folder : folder + "/", limits.file_bytes, {}};
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keep_image, &document.image_bytes);
    parser.SetFsCallbacks({file_exists, expand_file_path, read_whole_file, nullptr, &access});
    std::string error;
    std::string warning;  // files that nobody uses are missing, or will be named by whoever misses them
    bool parsed = false;
    try {
        const auto size = static_cast<unsigned>(bytes.size());
        parsed = is_glb(bytes)
                     ? parser.LoadBinaryFromMemory(&document.model, &error, &warning, bytes.data(), size, access.folder)
                     : parser.LoadASCIIFromString(&document.model, &error, &warning, json.data(), size, access.folder);
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    // An unknown extension is the better explanation of whatever else went wrong.
    const std::string unknown = unknown_required_extensions(document.model);
    if (!unknown.empty()) return refuse("requires the glTF extension " + unknown + ", which Macula does not know");
    if (!access.refusal.empty()) return refuse(access.refusal);
    const std::string complaint = complaints(error);
    if (!parsed || !complaint.empty()) return refuse("not valid glTF: " + complaint);
    if (document.model.asset.version.rfind("2.", 0) != 0)
        return refuse("glTF version " + document.model.asset.version + "; Macula reads 2.0");
    document.image_bytes.resize(document.model.images.size());
    return document;
}

}  // namespace macula
