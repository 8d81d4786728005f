#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "scenes/gltf.h"

namespace macula {

using Bytes = std::vector<std::uint8_t>;

inline int gl_type_of(std::int8_t) {
    return 5120;
}
inline int gl_type_of(std::uint8_t) {
    return 5121;
}
inline int gl_type_of(std::int16_t) {
    return 5122;
}
inline int gl_type_of(std::uint16_t) {
    return 5123;
}
inline int gl_type_of(std::uint32_t) {
    return 5125;
}
inline int gl_type_of(float) {
    return 5126;
}

/// Writes small glTF files. `json` may be changed at will before the file is made; one buffer holds all data.
class GltfBuilder {
public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};

    /// A scene of one node with one mesh of one triangle in the plane z = 0: primitive() is the one to play with.
    static GltfBuilder triangle() {
        GltfBuilder b;
        const int positions = b.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
        b.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
        b.json["nodes"] = {{{"mesh", 0}}};
        b.json["scenes"] = {{{"nodes", {0}}}};
        b.json["scene"] = 0;
        return b;
    }
    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }
    nlohmann::json& node() { return json["nodes"][0]; }

    /// The triangle with texture coordinates (set 0) and a material to play with.
    static GltfBuilder textured_triangle() {
        GltfBuilder b = triangle();
        b.primitive()["attributes"]["TEXCOORD_0"] = b.accessor<float>("VEC2", {0, 1, 1, 1, 0, 0});
        b.primitive()["material"] = 0;
        b.json["materials"] = {nlohmann::json::object()};
        return b;
    }
    nlohmann::json& material() { return json["materials"][0]; }

    int view(const Bytes& bytes, int stride = 0) {
        while (buffer.size() % 4 != 0) buffer.push_back(0);
        nlohmann::json v = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
        if (stride != 0) v["byteStride"] = stride;
        buffer.insert(buffer.end(), bytes.begin(), bytes.end());
        return push("bufferViews", v);
    }

    template <class T>
    static Bytes bytes_of(const std::vector<T>& values) {
        Bytes bytes(values.size() * sizeof(T));
        std::memcpy(bytes.data(), values.data(), bytes.size());
        return bytes;
    }

    template <class T>
    int accessor(const std::string& type, const std::vector<T>& values, bool normalized = false) {
        nlohmann::json a = {{"bufferView", view(bytes_of(values))},
                            {"componentType", gl_type_of(T())},
                            {"count", values.size() / components(type)},
                            {"type", type}};
        if (normalized) a["normalized"] = true;
        return push("accessors", a);
    }

    /// A texture whose image lies in a buffer view.
    int texture(const Bytes& encoded) {
        const int image = push("images", {{"bufferView", view(encoded)}, {"mimeType", "image/png"}});
        return push("textures", {{"source", image}});
    }

    int push(const char* array, const nlohmann::json& value) {
        json[array].push_back(value);
        return static_cast<int>(json[array].size()) - 1;
    }

    static std::size_t components(const std::string& type) {
        return type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    }

    [[nodiscard]] Bytes glb() const {
        nlohmann::json document = json;
        if (!buffer.empty() && !document.contains("buffers")) document["buffers"] = {{{"byteLength", buffer.size()}}};
        return glb_of(document.dump(), buffer);
    }

    static Bytes glb_of(std::string text, Bytes binary) {
        while (text.size() % 4 != 0) text += ' ';
        while (binary.size() % 4 != 0) binary.push_back(0);
        Bytes file = {'g', 'l', 'T', 'F'};
        append_32(file, 2);
        append_32(file, 12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
        append_32(file, text.size());
        append_32(file, 0x4E4F534A);
        file.insert(file.end(), text.begin(), text.end());
        if (!binary.empty()) {
            append_32(file, binary.size());
            append_32(file, 0x004E4942);
            file.insert(file.end(), binary.begin(), binary.end());
        }
        return file;
    }

    /// The text form, its buffer as a data uri.
    [[nodiscard]] std::string gltf() const {
        nlohmann::json document = json;
        if (!buffer.empty() && !document.contains("buffers"))
            document["buffers"] = {
                {{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
        return document.dump();
    }

    static std::string base64(const Bytes& bytes) {
        constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t i = 0; i < bytes.size(); i += 3) {
            std::uint32_t word = 0;
            for (std::size_t j = 0; j < 3; ++j) word = word << 8U | (i + j < bytes.size() ? bytes[i + j] : 0U);
            for (std::size_t j = 0; j < 4; ++j)
                text += i + j > bytes.size() ? '=' : kDigits[word >> (18U - 6U * j) & 63U];
        }
        return text;
    }

    [[nodiscard]] Expected<LoadedScene> load(const GltfLimits& limits = {}) const {
        return load_gltf_from_memory(glb(), "test.glb", limits);
    }

    Bytes buffer;

private:
    static void append_32(Bytes& to, std::size_t value) {
        for (unsigned shift = 0; shift < 32; shift += 8) to.push_back(static_cast<std::uint8_t>(value >> shift));
    }
};

}  // namespace macula
