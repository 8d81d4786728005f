macula_test(display_test SOURCES unit/display_test.cpp LINK macula_masks LABELS fast)
macula_test(display_fuzz_test SOURCES fuzz/display_fuzz.cpp fuzz/display_fuzz_test.cpp LINK macula_masks LABELS fast)
macula_test(rank_tile_test SOURCES property/rank_tile_test.cpp LINK macula_masks LABELS fast)
macula_test(tile_tables_test SOURCES property/tile_tables_test.cpp LINK macula_masks LABELS fast)
macula_test(tile_sampler_test SOURCES property/tile_sampler_test.cpp LINK macula_masks LABELS fast)
macula_test(tile_sampler_levels_test SOURCES property/tile_sampler_levels_test.cpp LINK macula_masks LABELS fast)
macula_test(law_test
    SOURCES unit/law_test.cpp unit/sampling_preset_test.cpp property/level_map_test.cpp
    LINK macula_masks LABELS fast)
macula_bench(plan_bench SOURCES bench/plan_bench.cpp LINK macula_masks)
