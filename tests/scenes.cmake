add_library(macula_test_gltf STATIC support/encoded_image.cpp)
target_link_libraries(macula_test_gltf PUBLIC macula_scenes nlohmann_json::nlohmann_json PRIVATE PkgConfig::OIIO)

macula_test(gltf_test
    SOURCES unit/gltf_mesh_test.cpp unit/gltf_scene_test.cpp unit/gltf_material_test.cpp
        unit/gltf_material_extension_test.cpp unit/gltf_animation_test.cpp unit/gltf_camera_test.cpp
        unit/gltf_refusal_test.cpp unit/gltf_balloon_test.cpp unit/emissive_quads_test.cpp
        property/gltf_accessor_test.cpp
    LINK macula_test_gltf
    LABELS fast)
macula_test(animation_test SOURCES unit/animation_test.cpp LINK macula_scenes LABELS fast)
macula_test(needs_test SOURCES unit/needs_test.cpp LINK macula_scenes LABELS fast)
macula_test(bunny_box_test
    SOURCES unit/bunny_box_test.cpp property/mesh_attributes_test.cpp
    LINK macula_scenes
    LABELS fast)
macula_test(made_shapes_test SOURCES unit/made_shapes_test.cpp LINK macula_scenes LABELS fast)
macula_test(air_shed_test SOURCES unit/air_shed_test.cpp LINK macula_scenes)
macula_test(gltf_fuzz_test
    SOURCES fuzz/gltf_corpus.cpp fuzz/gltf_fuzz.cpp fuzz/gltf_fuzz_test.cpp
    LINK macula_test_gltf
    LABELS fast)
macula_test(obj_fuzz_test SOURCES fuzz/obj_fuzz.cpp fuzz/obj_fuzz_test.cpp LINK macula_scenes LABELS fast)
