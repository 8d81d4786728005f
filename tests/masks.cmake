macula_test(masks_rank_tile_test SOURCES property/rank_tile_test.cpp LINK macula_masks LABELS fast)
macula_test(masks_tile_tables_test SOURCES property/tile_tables_test.cpp LINK macula_masks LABELS fast)
macula_test(masks_law_test SOURCES unit/law_test.cpp LINK macula_masks LABELS fast)
macula_bench(masks_plan_bench SOURCES bench/plan_bench.cpp LINK macula_masks)
