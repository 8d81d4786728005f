macula_test(texture_test
    SOURCES unit/environment_test.cpp unit/texture_footprint_test.cpp unit/texture_levels_test.cpp unit/texture_lookup_test.cpp
    LINK macula_tracer macula_kernels macula_scenes
    LABELS fast)
macula_test(image_file_test SOURCES unit/image_file_test.cpp LINK macula_test_gltf macula_scenes LABELS fast)

# Tables and timings.
macula_bench(shimmer_bench SOURCES bench/shimmer_bench.cpp
    LINK macula_tracer macula_reconstruct macula_kernels macula_masks macula_scenes)
macula_bench(texture_bench SOURCES bench/texture_bench.cpp LINK macula_tracer macula_kernels macula_scenes)
