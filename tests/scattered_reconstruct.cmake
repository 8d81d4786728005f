macula_test(scattered_reconstruct_test
    SOURCES unit/reconstruction_test.cpp differential/scattered_test.cpp
    LINK macula_scattered_reconstruct macula_reconstruct macula_mesh_sampler macula_test_pictures
    LABELS fast threads)
macula_test(scattered_gl_test SOURCES differential/scattered_gl_test.cpp
    LINK macula_scattered_reconstruct macula_reconstruct macula_mesh_sampler macula_gl macula_test_pictures LABELS gl)
macula_bench(scattered_bench SOURCES bench/scattered_bench.cpp
    LINK macula_scattered_reconstruct macula_reconstruct macula_mesh_sampler macula_gl TBB::tbb)
