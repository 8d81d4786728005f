macula_test(reconstruct_test SOURCES differential/reconstruct_test.cpp LINK macula_reconstruct macula_test_pictures LABELS fast threads)
macula_test(reconstruct_gl_test SOURCES differential/reconstruct_gl_test.cpp
    LINK macula_reconstruct macula_gl macula_test_pictures LABELS gl)
macula_test(reconstructor_factory_test SOURCES unit/reconstructor_factory_test.cpp
    LINK macula_reconstructor_factory macula_gl macula_test_pictures LABELS gl)
macula_bench(reconstruct_bench SOURCES bench/reconstruct_bench.cpp LINK macula_reconstruct macula_gl TBB::tbb)
