# SPDX-License-Identifier: Apache-2.0
# How a folder's tests become one program, and its files, or all of it, tests of ctest.

# Every test of ctest keeps compiled kernels, models and worlds in one folder of the build tree: what one test
# compiled, others find. Tests of the caches themselves take folders of their own.
set(test_cache ${CMAKE_BINARY_DIR}/test_cache)

# add_test_program(NAME FILE...): a program of test files. `files_of_NAME` are their stems; for each file STEM.cpp,
# `program_of_STEM` is the program, `suites_of_STEM` GoogleTest's patterns of the test suites in the file.
function(add_test_program name)
    add_executable(${name} ${ARGN})
    target_link_libraries(${name} PRIVATE voxelume_runtime voxelume_oracles GTest::gmock_main)
    add_dependencies(${name} ${voxelume_helpers})
    target_compile_definitions(${name} PRIVATE VXL_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                               VXL_BINARY="$<TARGET_FILE:voxelume>")
    if(CMAKE_UNITY_BUILD) # A unit includes test files, whose anonymous types are their own.
        target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    endif()
    # With -Og, GCC 12 sees std::stop_source used before it is set.
    target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    set(stems "")
    foreach(file IN LISTS ARGN)
        get_filename_component(stem ${file} NAME_WE)
        list(APPEND stems ${stem})
        file(READ ${file} text)
        string(REGEX MATCHALL "TEST(_[FP])?\\([ \n]*[A-Za-z0-9_]+," tests "${text}")
        string(REGEX REPLACE "TEST(_[FP])?\\([ \n]*([A-Za-z0-9_]+)," "\\2.*:*/\\2.*" suites "${tests}")
        list(REMOVE_DUPLICATES suites)
        list(JOIN suites ":" suites)
        set(program_of_${stem} ${name} PARENT_SCOPE)
        set(suites_of_${stem} ${suites} PARENT_SCOPE)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})  # its suites
    endforeach()
    set(files_of_${name} ${stems} PARENT_SCOPE)
endfunction()

# patterns_of(VARIABLE FILE...): GoogleTest's patterns of all suites in the files, named by their stems.
function(patterns_of variable)
    set(patterns "")
    foreach(stem IN LISTS ARGN)
        if(NOT DEFINED suites_of_${stem})
            message(FATAL_ERROR "tests/CMakeLists.txt names ${stem}.cpp, which is no file of tests")
        endif()
        list(APPEND patterns ${suites_of_${stem}})
    endforeach()
    list(JOIN patterns ":" patterns)
    set(${variable} "${patterns}" PARENT_SCOPE)
endfunction()

# PoCL links each kernel by the first ld that clang finds: 6 % less of the time of a kernel with gold.
if(GOLD)
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/linker)
    file(CREATE_LINK ${GOLD} ${CMAKE_BINARY_DIR}/linker/ld SYMBOLIC)
endif()

# finish_test(NAME): what all tests of ctest have in common. A filter that names no test fails.
function(finish_test name)
    set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT_MODIFICATION VOXELUME_CACHE_DIR=set:${test_cache})
    if(GOLD)
        set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT_MODIFICATION COMPILER_PATH=set:${CMAKE_BINARY_DIR}/linker)
    endif()
    # Compilers of kernels take and free much memory: in huge pages, which aren't given back at once, that takes 5 to 10 %
    # less of a test's time.
    set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT_MODIFICATION GLIBC_TUNABLES=set:glibc.malloc.hugetlb=1
                                                                       MALLOC_TOP_PAD_=set:67108864)
    # Helpers would take cores from other tests.
    set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT_MODIFICATION VOXELUME_COMPILERS=set:0)
    set_property(TEST ${name} APPEND PROPERTY FAIL_REGULAR_EXPRESSION "Running 0 tests")
endfunction()

# Tests whose kernels the OpenCL compiler optimizes, as it does for users: device functions, what compares rays with
# exact answers, and what compiling takes. The optimizer changes no bit (matrix_test, determinism_test), and takes half
# of the time of most tests.
set(optimized_tests voxelize_open_test
                    matrix_test kernels_tests verify_tests opencl_tests device_test pocl_folder_test program_cache_test
                    cli_cache_test cli_interrupt_test)

set(not_optimized VOXELUME_BUILD_OPTIONS=set:-cl-opt-disable)

# The tests that only `ctest -C slow` and `ctest -C exhaustive` have.
file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/slow_tests.txt slow_tests REGEX "^[^#]")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/slow_tests.txt)
list(TRANSFORM slow_tests REPLACE " *\\|.*" "")
list(JOIN slow_tests ":" slow_tests)

# without_slow(VARIABLE FILTER): a filter of GoogleTest without the slow tests.
function(without_slow variable filter)
    if(NOT filter MATCHES "-")
        string(APPEND filter ":-")
    endif()
    set(${variable} "${filter}:${slow_tests}" PARENT_SCOPE)
endfunction()

# add_run(NAME PROGRAM FILTER): tests of a program as one test of ctest. Where the optimizer is off by default,
# optimized.NAME has it, with `ctest -C exhaustive` alone.
function(add_run name program filter)
    without_slow(quick ${filter})
    add_test(NAME ${name} COMMAND ${program} --gtest_filter=${quick})
    finish_test(${name})
    if(NOT name IN_LIST optimized_tests)
        set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT_MODIFICATION ${not_optimized})
        add_test(NAME optimized.${name} CONFIGURATIONS exhaustive COMMAND ${program} --gtest_filter=${quick})
        finish_test(optimized.${name})
    endif()
endfunction()

# add_variant(NAME FILES STEM... [COMMAND WORD...] [EXCEPT PATTERN] [LABELS LABEL] [ENVIRONMENT NAME=VALUE...]
#             [EXHAUSTIVE | OPTIMIZED]): the tests of some files once more, one test of ctest for each program that has
# some, named NAME.PROGRAM. EXHAUSTIVE ones run with `ctest -C exhaustive` alone. Without either word the optimizer is
# off, and optimized.NAME.PROGRAM has it, with `ctest -C exhaustive` alone.
function(add_variant name)
    cmake_parse_arguments(PARSE_ARGV 1 variant "EXHAUSTIVE;OPTIMIZED" "EXCEPT;LABELS" "FILES;COMMAND;ENVIRONMENT")
    set(programs "")
    foreach(stem IN LISTS variant_FILES)
        list(APPEND programs ${program_of_${stem}})
        list(APPEND chosen_of_${program_of_${stem}} ${stem})
    endforeach()
    list(REMOVE_DUPLICATES programs)
    set(configurations "")
    if(variant_EXHAUSTIVE)
        set(configurations CONFIGURATIONS exhaustive)
    endif()
    foreach(program IN LISTS programs)
        patterns_of(patterns ${chosen_of_${program}})
        if(variant_EXCEPT)
            string(APPEND patterns ":-${variant_EXCEPT}")
        endif()
        set(command COMMAND ${variant_COMMAND} $<TARGET_FILE:${program}>)
        set(quick ${patterns})
        if(NOT variant_EXHAUSTIVE AND NOT variant_OPTIMIZED)
            without_slow(quick ${patterns})
        endif()
        add_test(NAME ${name}.${program} ${configurations} ${command} --gtest_filter=${quick})
        set(tests ${name}.${program})
        if(NOT variant_EXHAUSTIVE AND NOT variant_OPTIMIZED)
            add_test(NAME optimized.${name}.${program} CONFIGURATIONS exhaustive ${command} --gtest_filter=${patterns})
            list(APPEND tests optimized.${name}.${program})
        endif()
        foreach(test IN LISTS tests)
            set_tests_properties(${test} PROPERTIES LABELS "${variant_LABELS}" ENVIRONMENT "${variant_ENVIRONMENT}")
            finish_test(${test})
        endforeach()
        if(NOT variant_EXHAUSTIVE AND NOT variant_OPTIMIZED)
            set_property(TEST ${name}.${program} APPEND PROPERTY ENVIRONMENT_MODIFICATION ${not_optimized})
        endif()
    endforeach()
endfunction()
