#include "tests/fuzz/gltf_corpus.h"

#include "tests/support/encoded_image.h"

namespace macula {
namespace {

nlohmann::json transformed(int texture) {
    return {{"index", texture}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 3}}, {"rotation", 1}}}}}};
}

void add_attributes(GltfBuilder& b) {
    auto& attributes = b.primitive()["attributes"];
    attributes["NORMAL"] = b.accessor<std::int8_t>("VEC4", {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, true);
    b.json["accessors"].back()["type"] = "VEC3";
    b.json["bufferViews"].back()["byteStride"] = 4;
    attributes["COLOR_0"] = b.accessor<std::uint16_t>("VEC4", std::vector<std::uint16_t>(12, 30000), true);
    attributes["TEXCOORD_1"] = b.accessor<std::uint8_t>("VEC2", {0, 9, 200, 30, 100, 255, 7, 8}, true);
    b.json["accessors"].back()["count"] = 3;
    attributes["TANGENT"] = b.accessor<float>("VEC4", {1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, -1});
    b.primitive()["indices"] = b.accessor<std::uint16_t>("SCALAR", {0, 1, 2, 1, 0});
    b.primitive()["mode"] = 5;
    const int indices = b.view({1});
    const int values = b.view(GltfBuilder::bytes_of<float>({2, 0, 0}));
    b.json["accessors"][0]["sparse"] = {{"count", 1},
                                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", values}}}};
}

void add_materials(GltfBuilder& b) {
    const int png = b.texture(encode_image("png", 3, 2, 3, Bytes(18, 100)));
    const int jpeg = b.texture(encode_image("jpeg", 8, 8, 3, Bytes(192, 90)));
    const int webp = b.texture(encode_image("png", 2, 1, 4, Bytes(8, 200)));
    const int image = b.push(
        "images", {{"bufferView", b.view(encode_image("webp", 4, 4, 3, Bytes(48, 60)))}, {"mimeType", "image/webp"}});
    b.json["textures"][static_cast<std::size_t>(webp)]["extensions"]["EXT_texture_webp"]["source"] = image;
    b.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    b.json["textures"][0]["sampler"] = 0;
    b.material() = {{"pbrMetallicRoughness",
                     {{"baseColorTexture", {{"index", jpeg}, {"texCoord", 1}}}, {"baseColorFactor", {1, 0.5, 1, 1}}}},
                    {"normalTexture", transformed(png)},
                    {"alphaMode", "MASK"},
                    {"doubleSided", true}};
    b.json["materials"].push_back(
        {{"name", "glass"},
         {"alphaMode", "BLEND"},
         {"emissiveFactor", {1, 0.5, 0.25}},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}},
           {"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_specular",
            {{"specularFactor", 0.5},
             {"specularTexture", transformed(webp)},
             {"specularColorFactor", {1, 2, 1}},
             {"specularColorTexture", {{"index", jpeg}}}}},
           {"KHR_materials_clearcoat",
            {{"clearcoatFactor", 0.5},
             {"clearcoatRoughnessFactor", 0.25},
             {"clearcoatTexture", {{"index", png}}},
             {"clearcoatRoughnessTexture", {{"index", png}, {"texCoord", 1}}},
             {"clearcoatNormalTexture", {{"index", png}, {"scale", 0.5}}}}},
           {"KHR_materials_sheen",
            {{"sheenColorFactor", {0.5, 0.5, 1}},
             {"sheenRoughnessFactor", 0.5},
             {"sheenColorTexture", {{"index", jpeg}}},
             {"sheenRoughnessTexture", {{"index", webp}}}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.75}, {"transmissionTexture", {{"index", png}}}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 0.125},
             {"thicknessTexture", {{"index", png}}},
             {"attenuationDistance", 0.5},
             {"attenuationColor", {0.5, 1, 0.25}}}}}}});
    b.json["materials"].push_back({{"name", "lamp"}, {"emissiveFactor", {1, 1, 1}}});
}

void add_meshes(GltfBuilder& b) {
    nlohmann::json glass = b.primitive();
    glass["material"] = 1;
    glass.erase("mode");
    glass["indices"] = b.accessor<std::uint8_t>("SCALAR", {0, 1, 2});
    b.json["meshes"][0]["primitives"].push_back(glass);
    const int corners = b.accessor<float>("VEC3", {0, 2, 0, 1, 2, 0, 0, 2, 1, 1, 2, 1});
    b.json["meshes"].push_back({{"primitives",
                                 {{{"attributes", {{"POSITION", corners}}},
                                   {"indices", b.accessor<std::uint32_t>("SCALAR", {0, 1, 2, 2, 1, 3})},
                                   {"material", 2},
                                   {"targets", {{{"POSITION", corners}}}}}}}});
}

void add_nodes(GltfBuilder& b) {
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 10}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
        {{"type", "directional"}, {"color", {1, 0.5, 0.25}}},
        {{"type", "point"}, {"range", 7}}};
    b.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}, {"name", "eye"}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 9}}}}};
    b.json["skins"] = {{{"joints", {4}}}};
    b.json["nodes"] = {{{"children", {1, 2, 3, 4}}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {1, 2, -3}}},
                       {{"mesh", 0}, {"translation", {1, 2, 3}}, {"skin", 0}},
                       {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 4, 5, 6, 1}}, {"camera", 0}},
                       {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"children", {5}}},
                       {{"mesh", 1}, {"name", "lamp"}},
                       {{"mesh", 1}, {"camera", 1}, {"extensions", {{"KHR_lights_punctual", {{"light", 2}}}}}}};
}

void add_animations(GltfBuilder& b) {
    const int two = b.accessor<float>("SCALAR", {0, 1.5F});
    const int three = b.accessor<float>("SCALAR", {0.25F, 1, 2});
    const int turns = b.accessor<std::int16_t>("VEC4", {0, 0, 0, 32767, 0, 23170, 0, 23170}, true);
    const int places = b.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 3, 0});
    std::vector<float> spline(27, 0.5F);
    b.json["animations"] = {
        {{"name", "walk"},
         {"samplers",
          {{{"input", two}, {"output", turns}},
           {{"input", three}, {"output", places}, {"interpolation", "STEP"}},
           {{"input", three}, {"output", b.accessor<float>("VEC3", spline)}, {"interpolation", "CUBICSPLINE"}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}},
           {{"sampler", 1}, {"target", {{"node", 3}, {"path", "translation"}}}},
           {{"sampler", 2}, {"target", {{"node", 1}, {"path", "scale"}}}},
           {{"sampler", 1}, {"target", {{"node", 1}, {"path", "weights"}}}}}}},
        {{"samplers", {{{"input", two}, {"output", b.accessor<float>("VEC3", {1, 1, 1, 0, 0, 0})}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 4}, {"path", "scale"}}}}}}}};
}

}  // namespace

GltfBuilder gltf_with_everything() {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.json["extensionsUsed"] = {"EXT_none",
                                "EXT_texture_webp",
                                "KHR_lights_punctual",
                                "KHR_materials_clearcoat",
                                "KHR_materials_emissive_strength",
                                "KHR_materials_ior",
                                "KHR_materials_sheen",
                                "KHR_materials_specular",
                                "KHR_materials_transmission",
                                "KHR_materials_unlit",
                                "KHR_materials_volume",
                                "KHR_mesh_quantization",
                                "KHR_texture_transform"};
    add_attributes(b);
    add_materials(b);
    add_meshes(b);
    add_nodes(b);
    add_animations(b);
    return b;
}

}  // namespace macula
