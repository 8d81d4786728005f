macula_test(mesh_reconstruct_test SOURCES differential/mesh_reconstruct_test.cpp
    LINK macula_mesh_reconstruct macula_test_pictures LABELS fast threads)
macula_test(mesh_reconstruct_gl_test SOURCES differential/mesh_reconstruct_gl_test.cpp
    LINK macula_mesh_reconstruct macula_gl macula_test_pictures LABELS gl)
macula_bench(mesh_reconstruct_bench SOURCES bench/mesh_reconstruct_bench.cpp
    LINK macula_mesh_reconstruct macula_reconstruct macula_mask_making macula_gl TBB::tbb)
