# Benchmarks and tests of the whole way of a frame.
macula_bench(speedup_bench SOURCES bench/speedup_bench.cpp LINK macula_tracer macula_reconstruct macula_masks macula_scenes)
macula_bench(scaling_bench SOURCES bench/scaling_bench.cpp LINK macula_tracer macula_scenes embree TBB::tbb)
target_compile_definitions(scaling_bench PRIVATE MACULA_EMBREE_MAJOR=${embree_VERSION_MAJOR})
