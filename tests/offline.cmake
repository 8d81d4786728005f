macula_test(offline_test
    SOURCES unit/offline_accumulate_test.cpp unit/offline_layers_test.cpp unit/offline_shot_test.cpp
    LINK macula_offline
    LABELS fast)
macula_test(render_program_test
    SOURCES integration/render_program_test.cpp support/program.cpp
    LINK macula_base macula_scenes nlohmann_json::nlohmann_json PkgConfig::OIIO)
target_compile_definitions(render_program_test PRIVATE MACULA_RENDER="$<TARGET_FILE:macula-render>")
add_dependencies(render_program_test macula-render)
