macula_test(mask_tool_test
    SOURCES unit/mask_tool_chart_test.cpp unit/mask_tool_commands_test.cpp unit/mask_tool_figures_test.cpp
            unit/mask_tool_inspection_test.cpp unit/mask_tool_svg_test.cpp support/program.cpp
    LINK macula_mask_tool nlohmann_json::nlohmann_json PkgConfig::OIIO
    LABELS fast)
macula_test(mask_program_test
    SOURCES integration/mask_program_test.cpp support/program.cpp
    LINK macula_base nlohmann_json::nlohmann_json PkgConfig::OIIO)
target_compile_definitions(mask_program_test PRIVATE MACULA_MASK="$<TARGET_FILE:macula-mask>")
add_dependencies(mask_program_test macula-mask)
