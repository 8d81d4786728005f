macula_test(mask_making_test
    SOURCES property/mask_placement_test.cpp property/mask_share_test.cpp unit/mask_png_test.cpp
            unit/mask_recipe_test.cpp unit/mesh_store_test.cpp
    LINK macula_mask_making PkgConfig::OIIO
    LABELS fast)
macula_test(mask_preset_test SOURCES integration/mask_preset_test.cpp LINK macula_mask_making)
macula_bench(mask_bench SOURCES bench/mask_bench.cpp LINK macula_mask_making)
