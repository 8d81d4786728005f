#include "masks/mesh/mesh_file.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include <tiny_gltf.h>

namespace macula {
namespace {

using Position = std::array<float, 3>;

/// A GLB file counts its bytes in 32 bits; the rest is more than the JSON needs.
constexpr std::size_t kMaxBuffer_bytes = (std::size_t{1} << 32U) - (std::size_t{16} << 20U);

tinygltf::BufferView view_of(std::size_t offset, std::size_t bytes, int target) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = offset;
    view.byteLength = bytes;
    view.target = target;
    return view;
}

tinygltf::Accessor accessor_of(int view, std::size_t count, int type, int component_type) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.count = count;
    accessor.type = type;
    accessor.componentType = component_type;
    return accessor;
}

/// Positions, then corners.
std::vector<unsigned char> pack(const SampleMesh& mesh) {
    const std::size_t position_bytes = mesh.site.size() * sizeof(Position);
    const std::size_t corner_bytes = mesh.triangle.size() * sizeof(SampleMesh::Triangle);
    std::vector<unsigned char> bytes(position_bytes + corner_bytes);
    for (std::size_t i = 0; i < mesh.site.size(); ++i) {
        const Position p = {static_cast<float>(mesh.site[i].x_px), static_cast<float>(-mesh.site[i].y_px), 0.0F};
        std::memcpy(&bytes[i * sizeof(p)], p.data(), sizeof(p));
    }
    if (corner_bytes > 0) std::memcpy(&bytes[position_bytes], mesh.triangle.data(), corner_bytes);
    return bytes;
}

tinygltf::Value describe(const SampleMesh& mesh) {
    using tinygltf::Value;
    Value::Object macula;
    macula["width_px"] = Value(mesh.width_px);
    macula["height_px"] = Value(mesh.height_px);
    macula["gaze_px"] = Value(Value::Array{Value(mesh.gaze_px.x), Value(mesh.gaze_px.y)});
    macula["recipe"] = Value(mesh.recipe);
    return Value(Value::Object{{"macula", Value(std::move(macula))}});
}

tinygltf::Model model_of(const SampleMesh& mesh) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "Macula";
    model.asset.extras = describe(mesh);
    model.buffers.resize(1);
    model.buffers[0].data = pack(mesh);
    const std::size_t position_bytes = mesh.site.size() * sizeof(Position);
    model.bufferViews = {
        view_of(0, position_bytes, TINYGLTF_TARGET_ARRAY_BUFFER),
        view_of(position_bytes, model.buffers[0].data.size() - position_bytes, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER)};
    model.accessors = {
        accessor_of(0, mesh.site.size(), TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT),
        accessor_of(1, 3 * mesh.triangle.size(), TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)};
    // The corners of the mask are sites.
    model.accessors[0].minValues = {0.0, 1.0 - mesh.height_px, 0.0};
    model.accessors[0].maxValues = {mesh.width_px - 1.0, 0.0, 0.0};
    model.accessors[1].minValues = {0.0};
    model.accessors[1].maxValues = {static_cast<double>(mesh.site.size()) - 1.0};

    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = 0;
    primitive.indices = 1;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    model.meshes.resize(1);
    model.meshes[0].name = "sampling mask";
    model.meshes[0].primitives = {std::move(primitive)};
    model.nodes.resize(1);
    model.nodes[0].mesh = 0;
    model.scenes.resize(1);
    model.scenes[0].nodes = {0};
    model.defaultScene = 0;
    return model;
}

/// A name beside `path` that no other thread or process uses.
std::string partial_name(const std::string& path) {
    static std::atomic<unsigned> count = 0;
    return path + "." + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".part";
}

}  // namespace

Expected<void> write_mesh(const SampleMesh& mesh, const std::string& path) {
    const auto refuse = [&path](const std::string& why) {
        return fail(ErrorCode::output, "cannot write " + path + ": " + why);
    };
    if (mesh.site.size() * sizeof(Position) + mesh.triangle.size() * sizeof(SampleMesh::Triangle) > kMaxBuffer_bytes)
        return refuse("the mesh is too large for a glTF file");
    const std::string partial = partial_name(path);
    std::ofstream file(partial, std::ios::binary);
    if (!file) return refuse(std::strerror(errno));
    std::string why;
    try {
        const tinygltf::Model model = model_of(mesh);
        if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, file, false, true)) why = "tinygltf refuses the mesh";
    } catch (const std::exception& exception) {  // of the JSON library, for text that is not UTF-8
        why = exception.what();
    }
    file.close();
    std::error_code error;
    if (why.empty() && !file) why = std::strerror(errno);
    if (why.empty()) std::filesystem::rename(partial, path, error);
    if (error) why = error.message();
    if (why.empty()) return {};
    std::filesystem::remove(partial, error);
    return refuse(why);
}

}  // namespace macula
