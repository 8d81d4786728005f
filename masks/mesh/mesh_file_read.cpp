#include "masks/mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <exception>
#include <fstream>
#include <limits>
#include <string_view>
#include <vector>

#include <tiny_gltf.h>

#include "protocol/base/glb.h"

namespace macula {
namespace {

using Position = std::array<float, 3>;

/// A GLB file counts its bytes in 32 bits.
constexpr std::size_t kMaxFile_bytes = std::numeric_limits<std::uint32_t>::max();

/// Takes a parsed file apart; keeps the first fault.
class MeshReader {
public:
    explicit MeshReader(const tinygltf::Model& model) : model_(model) {}

    SampleMesh read() {
        SampleMesh mesh;
        read_description(mesh);
        const tinygltf::Primitive primitive = find_primitive();
        const auto position = primitive.attributes.find("POSITION");
        const int positions = position == primitive.attributes.end() ? -1 : position->second;
        read_sites(mesh, elements(positions, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, sizeof(Position),
                                  "positions"));
        read_triangles(mesh, elements(primitive.indices, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                      sizeof(std::uint32_t), "indices"));
        return mesh;
    }

    [[nodiscard]] const std::string& fault() const { return fault_; }

private:
    void report(const std::string& what) {
        if (fault_.empty()) fault_ = what;
    }

    int whole_number(const tinygltf::Value& value, const std::string& name) {
        if (value.IsInt()) return value.GetNumberAsInt();
        report("asset.extras.macula." + name + " is missing or no whole number");
        return 0;
    }

    void read_description(SampleMesh& mesh) {
        const tinygltf::Value& extras = model_.asset.extras;
        if (!extras.Has("macula") || !extras.Get("macula").IsObject())
            return report("there is no asset.extras.macula: Macula has not made this file");
        const tinygltf::Value& macula = extras.Get("macula");
        mesh.width_px = whole_number(macula.Get("width_px"), "width_px");
        mesh.height_px = whole_number(macula.Get("height_px"), "height_px");
        const tinygltf::Value& gaze = macula.Get("gaze_px");
        if (!gaze.IsArray() || gaze.ArrayLen() != 2) return report("asset.extras.macula.gaze_px is not two numbers");
        mesh.gaze_px = {whole_number(gaze.Get(0), "gaze_px"), whole_number(gaze.Get(1), "gaze_px")};
        if (!macula.Get("recipe").IsString()) return report("asset.extras.macula.recipe is missing or no string");
        mesh.recipe = macula.Get("recipe").Get<std::string>();
    }

    tinygltf::Primitive find_primitive() {
        if (model_.meshes.size() == 1 && model_.meshes[0].primitives.size() == 1) {
            const tinygltf::Primitive& primitive = model_.meshes[0].primitives[0];
            if (primitive.mode == TINYGLTF_MODE_TRIANGLES) return primitive;
        }
        report("there is not one mesh of one primitive of triangles");
        return {};
    }

    /// The bytes of an accessor whose elements of `bytes_each` are tightly packed; none after a fault.
    std::span<const unsigned char> elements(int index, int type, int component_type, std::size_t bytes_each,
                                            const std::string& name) {
        if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size()) {
            report("there are no " + name);
            return {};
        }
        const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
        const auto view = static_cast<std::size_t>(accessor.bufferView);
        if (accessor.type != type || accessor.componentType != component_type || accessor.normalized ||
            accessor.sparse.isSparse || accessor.bufferView < 0 || view >= model_.bufferViews.size() ||
            model_.bufferViews[view].buffer != 0 || model_.buffers.empty() ||
            (model_.bufferViews[view].byteStride != 0 && model_.bufferViews[view].byteStride != bytes_each)) {
            report("the " + name + " are not laid out as Macula writes them");
            return {};
        }
        const std::span<const unsigned char> buffer = model_.buffers[0].data;
        const std::size_t start = model_.bufferViews[view].byteOffset;
        const std::size_t within = accessor.byteOffset;
        const std::size_t length = model_.bufferViews[view].byteLength;
        if (start > buffer.size() || length > buffer.size() - start || within > length ||
            accessor.count > (length - within) / bytes_each) {
            report("the " + name + " reach beyond the end of the buffer");
            return {};
        }
        return buffer.subspan(start + within, accessor.count * bytes_each);
    }

    void read_sites(SampleMesh& mesh, std::span<const unsigned char> bytes) {
        constexpr float kLargest_px = std::numeric_limits<std::int16_t>::max();
        mesh.site.resize(bytes.size() / sizeof(Position));
        for (std::size_t i = 0; i < mesh.site.size(); ++i) {
            Position p;
            std::memcpy(p.data(), &bytes[i * sizeof(p)], sizeof(p));
            const bool fits = p[0] >= 0.0F && p[0] <= kLargest_px && p[1] <= 0.0F && p[1] >= -kLargest_px;  // no NaN
            if (fits) mesh.site[i] = {static_cast<std::int16_t>(p[0]), static_cast<std::int16_t>(-p[1])};
            if (!fits || mesh.site[i].x_px != p[0] || mesh.site[i].y_px != -p[1] || p[2] != 0.0F)
                return report("position " + std::to_string(i) + " is not (x, -y, 0) of a pixel");
        }
    }

    void read_triangles(SampleMesh& mesh, std::span<const unsigned char> bytes) {
        if (bytes.size() % sizeof(SampleMesh::Triangle) != 0)
            return report("the number of indices is not a multiple of 3");
        mesh.triangle.resize(bytes.size() / sizeof(SampleMesh::Triangle));
        if (!bytes.empty()) std::memcpy(mesh.triangle.data(), bytes.data(), bytes.size());
    }

    const tinygltf::Model& model_;
    std::string fault_;
};

// All that a mesh needs is in its file. tinygltf is told that any other exists, so that it tells why that is not read.
bool any_file(const std::string& /*path*/, void* /*user*/) {
    return true;
}
std::string same_path(const std::string& path, void* /*user*/) {
    return path;
}
bool no_content(std::vector<unsigned char>* /*out*/, std::string* error, const std::string& /*path*/, void* /*user*/) {
    *error += "a mesh refers to no other file";
    return false;
}
bool no_image(tinygltf::Image* /*image*/, int /*index*/, std::string* /*error*/, std::string* /*warning*/,
              int /*width*/, int /*height*/, const unsigned char* /*bytes*/, int /*size*/, void* /*user*/) {
    return true;
}

/// What is wrong with a file that tinygltf does not parse, on one line; empty if nothing is.
std::string parse(std::span<const std::uint8_t> bytes, tinygltf::Model& model) {
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(no_image, nullptr);
    parser.SetFsCallbacks({any_file, same_path, no_content, nullptr, nullptr});
    std::string error;
    std::string warning;  // of nothing that is used
    bool parsed = false;
    try {
        parsed = parser.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(),
                                             static_cast<unsigned>(bytes.size()), std::string());
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    if (parsed && error.empty()) return {};
    std::replace(error.begin(), error.end(), '\n', ' ');
    return "not valid glTF: " + error;
}

}  // namespace

Expected<SampleMesh> read_mesh_from_memory(std::span<const std::uint8_t> bytes, const std::string& name) {
    const auto refuse = [&name](const std::string& what) { return fail(ErrorCode::input_file, name + ": " + what); };
    if (!is_glb(bytes)) return refuse("not a binary glTF 2.0 file (.glb)");
    const Expected<std::string_view> json = glb_json(bytes);
    if (!json) return refuse(json.error().message);
    if (json_depth(*json) > kMaxJsonDepth) return refuse("the JSON is nested too deeply");
    tinygltf::Model model;
    const std::string complaint = parse(bytes, model);
    if (!complaint.empty()) return refuse(complaint);
    MeshReader reader(model);
    SampleMesh mesh = reader.read();
    if (!reader.fault().empty()) return refuse(reader.fault());
    const std::string defect = mesh_defect(mesh);
    if (!defect.empty()) return refuse(defect);
    return mesh;
}

Expected<SampleMesh> read_mesh(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return fail(ErrorCode::input_file, "cannot open " + path + ": " + std::strerror(errno));
    const std::streamoff size = file.tellg();
    if (size < 0 || static_cast<std::uint64_t>(size) > kMaxFile_bytes)
        return fail(ErrorCode::input_file, path + " is not a file, or larger than a binary glTF file can be");
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(bytes.data()), size);
    if (!file) return fail(ErrorCode::input_file, "cannot read " + path);
    return read_mesh_from_memory(bytes, path);
}

}  // namespace macula
