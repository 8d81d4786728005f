macula_test(rivals_test
    SOURCES property/rivals_test.cpp differential/grid_reconstruct_test.cpp
    LINK macula_rivals macula_grid_reconstruct macula_test_pictures
    LABELS fast)
macula_test(grid_reconstruct_gl_test SOURCES differential/grid_reconstruct_gl_test.cpp
    LINK macula_rivals macula_grid_reconstruct macula_gl macula_test_pictures
    LABELS gl)
macula_bench(rivals_bench SOURCES bench/rivals_bench.cpp LINK macula_rivals macula_grid_reconstruct macula_gl TBB::tbb)
