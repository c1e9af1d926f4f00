# Tests on other devices than the machine's own: under the limits of others (limits_layer), and on a second driver.

# The tests of passes, on sizes that are small and between them run every pass; for other devices and drivers.
set(pass_test_filter */sheet_17x16:*/sheet_3x1023:*/list_31x33:*/mesh_31x33:*/graded_mesh_17x13:*/explicit_31x33:*/runge_kutta_mesh:Denormals.*)
set(body_pass_test_filter */box_26_rich:*/sphere_252_rich:*/blob_1000:*/springs_alone:*/springs_by_list)
set(solver_pass_test_filter
    */sheet_3x65:*/sheet_stiff_bend:*/sheet_jacobi:*/sheet_plain:*/mesh_17x13:*/graded_mesh:*/acad_sheet:*/acad_mesh:*/paper_mesh:*/paper_acad)
set(sheet_steps_test_filter */33x129:*/131x7:SheetDispatches.*)
set(programs pass_test body_pass_test solver_pass_test sheet_steps_test)

foreach(device quest3 mali_g78 mali_g57 adreno_610 apple_m1 iris_xe)
    foreach(program IN LISTS programs)
        set(test limits.${device}.${program})
        add_test(NAME ${test} COMMAND pliant_tests ${program} --gtest_filter=${${program}_filter})
        set_tests_properties(${test} PROPERTIES TIMEOUT 3600 LABELS all ENVIRONMENT
            "PLIANT_TEST_DEVICE=${device};PLIANT_EXPECT_DEVICE=${device} over llvmpipe;VK_LOADER_DRIVERS_SELECT=*lvp*;VK_LAYER_PATH=${limits_layer_path};VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation:VK_LAYER_PLIANT_limits")
    endforeach()
endforeach()
set_tests_properties(limits.quest3.pass_test limits.quest3.body_pass_test PROPERTIES LABELS quick)

add_test(NAME machine_report COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/machine_report_test.py $<TARGET_FILE:pliant_tool>)
set_tests_properties(machine_report PROPERTIES TIMEOUT 600 ENVIRONMENT "VK_LOADER_DRIVERS_SELECT=*lvp*")
add_test(NAME limits.refusals COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/limits_refusals_test.py $<TARGET_FILE:pliant_tool>
    ${limits_layer_path})
set_tests_properties(limits.refusals PROPERTIES TIMEOUT 600)

foreach(program IN LISTS programs)
    add_test(NAME swiftshader.${program} COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/second_driver_test.py tests
        $<TARGET_FILE:pliant_tests> ${program} --gtest_filter=${${program}_filter})
    set_tests_properties(swiftshader.${program} PROPERTIES TIMEOUT 3600 LABELS all SKIP_RETURN_CODE 77)
endforeach()
# Sheets of odd sizes, by the hashes that all must have.
add_test(NAME swiftshader.golden_test COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/second_driver_test.py tests
    $<TARGET_FILE:pliant_tests> golden_test --gtest_filter=*_*x*)
set_tests_properties(swiftshader.golden_test PROPERTIES TIMEOUT 3600 LABELS all SKIP_RETURN_CODE 77 ENVIRONMENT PLIANT_GOLDEN=vulkan)
# Every scene, on few frames and where it is large on few nodes: it is slow.
add_test(NAME swiftshader.scenes COMMAND ${PYTHON3} ${CMAKE_CURRENT_SOURCE_DIR}/second_driver_test.py scenes
    $<TARGET_FILE:pliant_tool> parity:2 flag:1 wind_list:1 falling_sheet:5 chain:2 hanging:1 incline_rest:2 incline_slide:2
    moving_sphere:2 box_capsule:1 "cloth_sphere:1:cloths[0].sheet.rows=33:cloths[0].sheet.columns=47" hanging_constraint:1
    tablecloth:1 paper_fig10:2 paper_fig14:1 paper_fig15:1 twist:2 free_fall:4 inflate:1 local_deform:1 many:1 press:3
    stiffness_sweep:3)
set_tests_properties(swiftshader.scenes PROPERTIES TIMEOUT 3600 LABELS all SKIP_RETURN_CODE 77)
