macula_test(mesh_sampler_test
    SOURCES property/mesh_off_axis_test.cpp property/mesh_sampler_test.cpp property/mesh_table_test.cpp
    LINK macula_mesh_sampler macula_mask_making
    LABELS fast)
macula_bench(mesh_plan_bench SOURCES bench/mesh_plan_bench.cpp LINK macula_mesh_sampler macula_mask_making)
