# macula_kernel_text(TARGET FILE...): embeds kernel headers and GLSL files (paths from the project root) as C++
# strings, at build. For server/kernels/reconstruct.h the sources of TARGET can then
#
#     #include "kernel_text/reconstruct.h"     // inline constexpr macula::KernelText reconstruct_text
#
# Preprocessor lines of headers are emptied: GLSL has no #include and gets its macros from kernel_prelude.glsl.
# Line numbers stay. The same file, run by `cmake -P`, does the conversion.

if(CMAKE_SCRIPT_MODE_FILE)
    file(READ "${ROOT}/${FILE}" text)
    if(FILE MATCHES "\\.h$")
        string(REGEX REPLACE "\n[ \t]*#[^\n]*" "\n" text "\n${text}")
        string(SUBSTRING "${text}" 1 -1 text)
    endif()
    get_filename_component(name "${FILE}" NAME_WE)
    file(WRITE "${OUTPUT}" "// Made from ${FILE} by protocol/gl/kernel_text.cmake.
#pragma once
#include \"protocol/gl/compute.h\"
namespace macula {
inline constexpr KernelText ${name}_text = {\"${FILE}\", R\"KERNEL_TEXT(${text})KERNEL_TEXT\"};
}  // namespace macula
")
    return()
endif()

function(macula_kernel_text target)
    set(script ${PROJECT_SOURCE_DIR}/protocol/gl/kernel_text.cmake)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_texts)
    foreach(file ${ARGN})
        get_filename_component(name ${file} NAME_WE)
        set(output ${folder}/kernel_text/${name}.h)
        add_custom_command(OUTPUT ${output}
            COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -DFILE=${file} -DOUTPUT=${output} -P ${script}
            DEPENDS ${PROJECT_SOURCE_DIR}/${file} ${script}
            COMMENT "Embedding ${file}" VERBATIM)
        target_sources(${target} PRIVATE ${output})
    endforeach()
    target_include_directories(${target} SYSTEM PRIVATE ${folder})
endfunction()
