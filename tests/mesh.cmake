macula_test(mesh_test
    SOURCES property/triangulate_test.cpp property/delaunay_flip_test.cpp unit/sample_mesh_test.cpp
        unit/mesh_file_test.cpp unit/mesh_quality_test.cpp fuzz/mesh_file_fuzz.cpp fuzz/mesh_file_fuzz_test.cpp
    LINK macula_mesh macula_scenes nlohmann_json::nlohmann_json
    LABELS fast)
macula_bench(mesh_bench SOURCES bench/mesh_bench.cpp LINK macula_mesh)
