# The detection experiment: the client's side in C++, schedule and analysis in Python.
macula_test(study_test SOURCES unit/study_test.cpp LINK macula_study LABELS fast)
macula_test(study_program_test
    SOURCES integration/study_program_test.cpp support/program.cpp
    LINK macula_base)
target_compile_definitions(study_program_test PRIVATE
    MACULA_SERVER="$<TARGET_FILE:macula-server>" MACULA_CLIENT="$<TARGET_FILE:macula-client>")
add_dependencies(study_program_test macula-server macula-client)

# Where something is missing they say so and are skipped (exit code 77).
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
    foreach(part schedule)
        add_test(NAME study_${part}_python COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/study/${part}_test.py)
        set_tests_properties(study_${part}_python PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 120)
    endforeach()
else()
    message(STATUS "no Python 3: the tests of tests/study/*.py are left out")
endif()
