# Benchmarks and tests of the whole way of a frame.
macula_bench(speedup_bench SOURCES bench/speedup_bench.cpp LINK macula_tracer macula_reconstruct macula_masks macula_scenes)
