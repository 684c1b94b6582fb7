# SPDX-License-Identifier: Apache-2.0
# Tests that run once more: with other numbers of lanes, with guarded memory, as on a GPU, on oclgrind. What runs by
# default pairs every test with some setting and every setting with some test; `ctest -C exhaustive` and
# `./bootstrap.sh test --all` add all other pairs. tests/README.md lists them.

# The kernels' tests and golden bits with each number of lanes. By default a fourth of the tests has
# each; glibc fills memory with another byte each time, so that a value nobody wrote shows.
set(files_with_lanes sight_test shade_test light_test resolve_test index_test golden_test)
set(all_lanes 1 4 8 16)
foreach(quarter RANGE 3)
    foreach(lanes IN LISTS all_lanes)
        list(FIND all_lanes ${lanes} own_quarter)
        set(exhaustive EXHAUSTIVE)
        if(quarter EQUAL own_quarter)
            set(exhaustive "")
        endif()
        math(EXPR filling "${lanes} * 14 + 5")
        add_variant(lanes${lanes}.part${quarter} FILES ${files_with_lanes} ${exhaustive} EXCEPT *Lanes*:Golden.Volumes LABELS lanes
                    ENVIRONMENT VXL_TEST_LANES=${lanes} MALLOC_PERTURB_=${filling}
                                GTEST_TOTAL_SHARDS=4 GTEST_SHARD_INDEX=${quarter})
    endforeach()
endforeach()

foreach(lanes IN LISTS all_lanes)
    add_variant(lanes${lanes}.scenes FILES shipped_scenes_test golden_test instance_glass_test EXHAUSTIVE LABELS lanes
                ENVIRONMENT VXL_TEST_LANES=${lanes})
    add_variant(lanes${lanes} FILES trace_test OPTIMIZED EXCEPT *Lanes* LABELS lanes
                ENVIRONMENT VXL_TEST_LANES=${lanes})
endforeach()

# What images are made of on a host that takes denormal numbers for zero.
add_variant(flushed FILES golden_test ENVIRONMENT VXL_TEST_FLUSH=1)

# With every buffer against pages that may not be touched. The first list's kernels have no other checker of memory
# by default, the second's have oclgrind.
if(NOT VXL_SANITIZE)
    add_library(guarded_memory MODULE support/guarded_memory.cpp)
    target_link_libraries(guarded_memory PRIVATE voxelume_options ${CMAKE_DL_LIBS})
    set(guarded LABELS guarded ENVIRONMENT LD_PRELOAD=$<TARGET_FILE:guarded_memory>)
    add_variant(guarded FILES glass_cubes_test instance_glass_test medium_test immersed_image_test
                              placer_test trace_test EXCEPT *NoRayLeavesAClosedRoom ${guarded})
    add_variant(guarded.more FILES glass_cubes_test index_test light_test paths_image_test shade_test ${guarded}
                EXHAUSTIVE)
endif()

# As on a GPU: its lanes, batches and arithmetic, and each kernel compiled alone.
if(NOT VXL_SANITIZE)
    add_library(stand_in_gpu MODULE support/stand_in_gpu.cpp)
    target_link_libraries(stand_in_gpu PRIVATE voxelume_options ${CMAKE_DL_LIBS})
    set(gpu LABELS gpu ENVIRONMENT VXL_TEST_DEVICE=gpu LD_PRELOAD=$<TARGET_FILE:stand_in_gpu>)
    add_variant(gpu FILES golden_test ${gpu})
    add_variant(gpu.more FILES kernel_builds_test program_test shipped_scenes_test trace_test voxelize_test ${gpu}
                EXHAUSTIVE)
endif()

# On oclgrind, an OpenCL device that checks every access to memory. It only prints what it finds, so the text decides.
find_program(OCLGRIND oclgrind)
if(OCLGRIND)
    set(oclgrind LABELS oclgrind COMMAND ${OCLGRIND} --data-races
                 ENVIRONMENT VXL_TEST_DEVICE=oclgrind VXL_TEST_LANES=1)
    add_variant(oclgrind FILES buffer_test index_test lanes_test layout_test light_test program_test resolve_test
                               shade_test sight_test EXCEPT LensRays.FillThePolygon* OPTIMIZED ${oclgrind})
    add_variant(oclgrind.more FILES medium_test render_test render_lacks_test sight_test ${oclgrind} EXHAUSTIVE)
    get_property(tests DIRECTORY PROPERTY TESTS)
    list(FILTER tests INCLUDE REGEX "^oclgrind\\.")
    set(findings "Invalid (read|write)|data race|[Uu]ninitialized value|barrier divergence|FAILED")
    set_property(TEST ${tests} APPEND PROPERTY FAIL_REGULAR_EXPRESSION "${findings}")
    set_tests_properties(${tests} PROPERTIES TIMEOUT 600)
endif()

# A million rays of each class of `voxelume stress`; CI has fewer.
add_test(NAME stress.million CONFIGURATIONS exhaustive COMMAND voxelume stress --rays 1e6)
finish_test(stress.million)

# All scenes with every combination of settings: up to half an hour for each size of work-groups.
add_test(NAME matrix.product CONFIGURATIONS exhaustive
         COMMAND matrix_test --gtest_also_run_disabled_tests --gtest_filter=*Product*)
finish_test(matrix.product)
set_tests_properties(matrix.product PROPERTIES TIMEOUT 7200)
