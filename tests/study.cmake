# The detection experiment: the client's side in C++, schedule and analysis in Python.
macula_test(study_test SOURCES unit/study_test.cpp LINK macula_study LABELS fast)
macula_test(study_program_test
    SOURCES integration/study_program_test.cpp support/program.cpp
    LINK macula_base)
target_compile_definitions(study_program_test PRIVATE
    MACULA_SERVER="$<TARGET_FILE:macula-server>" MACULA_CLIENT="$<TARGET_FILE:macula-client>")
add_dependencies(study_program_test macula-server macula-client)

# Tests of what needs a package that is missing are skipped, and say so.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
    add_test(NAME study_python_test
        COMMAND ${Python3_EXECUTABLE} -B -m unittest discover -v -s ${CMAKE_CURRENT_SOURCE_DIR}/study -p "test_*.py")
    set_tests_properties(study_python_test PROPERTIES TIMEOUT 60)
else()
    message(STATUS "no Python 3: the tests of tests/study/*.py are left out")
endif()
