macula_test(mesh_sampler_test SOURCES property/mesh_sampler_test.cpp property/mesh_table_test.cpp
    LINK macula_mesh_sampler LABELS fast)
