# Compiles every shader to SPIR-V as numbers, to be included as "shaders/NAME.comp.inc".
find_program(GLSLC glslc REQUIRED)

# From the table of passes: `fast_passes` have a second module for --fast-math; each entry of `solver_passes` is
# "NAME UNIT TEXT", a row for which solver_pass.comp is compiled.
function(pliant_read_passes table)
    file(STRINGS ${table} rows REGEX "^[A-Z]+_PASS\\([a-z_]+,")
    foreach(row IN LISTS rows)
        string(REGEX MATCH "^([A-Z]+)_PASS\\(([a-z_]+), ([a-z_]+), ([a-z_]+), ([a-z]+)" match "${row}")
        set(family ${CMAKE_MATCH_1})
        set(name ${CMAKE_MATCH_2})
        set(third ${CMAKE_MATCH_3})
        set(fourth ${CMAKE_MATCH_4})
        set(fifth ${CMAKE_MATCH_5})
        list(APPEND passes ${name})
        if(family STREQUAL "CLOTH" OR family STREQUAL "BODY")
            if(fifth STREQUAL "fast")
                list(APPEND fast ${name})
            endif()
        elseif(family STREQUAL "SINGLE")
            list(APPEND solver "${name} ${fourth} ${fifth}")
        else()
            list(APPEND solver "${name} ${third} ${fifth}")
        endif()
    endforeach()
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${table})
    set(passes ${passes} PARENT_SCOPE)
    set(fast_passes ${fast} PARENT_SCOPE)
    set(solver_passes ${solver} PARENT_SCOPE)
endfunction()

# The command that compiles a source to shaders/VARIANT.inc, with flags.
function(pliant_compile_shader variant source)
    set(output ${PROJECT_BINARY_DIR}/generated/shaders/${variant}.inc)
    get_filename_component(folder ${source} DIRECTORY)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${GLSLC} --target-env=vulkan1.1 ${ARGN} -Werror -mfmt=num -MD -MF ${output}.d -MT ${output}
                -I ${PROJECT_SOURCE_DIR}/src -I ${PROJECT_SOURCE_DIR}/src/laws -I ${folder} ${source} -o ${output}
        DEPENDS ${source} DEPFILE ${output}.d
        COMMENT "Compiling ${variant}" VERBATIM)
    set(outputs ${outputs} ${output} PARENT_SCOPE)
endfunction()

# C++ text that defines an array for each module.
function(pliant_array_of_module name variant text)
    set(${text} "${${text}}constexpr std::uint32_t ${name}[] = {\n#include \"shaders/${variant}.inc\"\n};\n" PARENT_SCOPE)
endfunction()

function(pliant_add_shaders target)
    set(outputs)
    set(include_directory ${PROJECT_BINARY_DIR}/generated)
    file(MAKE_DIRECTORY ${include_directory}/shaders/fast)
    pliant_read_passes(${PROJECT_SOURCE_DIR}/src/solve/passes.def)
    list(APPEND passes sheet_steps)  # several calls of sheet_step in a dispatch
    list(APPEND fast_passes sheet_steps)
    # The optimiser fuses products and sums before with_exact_arithmetic (shader_code.hpp) can forbid it, so
    # compute shaders are not optimised here, only by the driver.
    foreach(folder IN LISTS ARGN)
        file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.comp ${folder}/*.vert ${folder}/*.frag)
        foreach(source IN LISTS sources)
            get_filename_component(name ${source} NAME)
            get_filename_component(pass ${source} NAME_WE)
            if(NOT name MATCHES "\\.comp$")
                pliant_compile_shader(${name} ${source} -O)
            elseif(NOT pass STREQUAL "solver_pass")
                pliant_compile_shader(${name} ${source} -O0)
                if(pass IN_LIST fast_passes)
                    pliant_compile_shader(fast/${name} ${source} -O -DFAST_MATH)
                endif()
            endif()
        endforeach()
    endforeach()
    foreach(row IN LISTS solver_passes)
        separate_arguments(row)
        list(GET row 0 name)
        list(GET row 1 unit)
        list(GET row 2 text)
        pliant_compile_shader(${name}.comp ${PROJECT_SOURCE_DIR}/src/backend/vulkan/shaders/solver_pass.comp -O0
                              -DPASS=${name} -DOVER=OVER_${unit} -DUNIT_${unit} -DTEXT_${text})
    endforeach()

    set(modules "// Made from src/solve/passes.def by cmake/PliantShaders.cmake.\n")
    foreach(name IN LISTS passes)
        pliant_array_of_module(${name} ${name}.comp modules)
    endforeach()
    string(APPEND modules "namespace fast {\n")
    foreach(name IN LISTS fast_passes)
        pliant_array_of_module(${name} fast/${name}.comp modules)
    endforeach()
    string(APPEND modules "}  // namespace fast\n")
    file(CONFIGURE OUTPUT ${include_directory}/shaders/modules.inc CONTENT "${modules}" @ONLY)

    add_custom_target(${target}_shaders DEPENDS ${outputs})
    add_dependencies(${target} ${target}_shaders)
    target_include_directories(${target} PRIVATE ${include_directory})
    # Embedded numbers are no sources of their own: rebuild what includes them when they change.
    set_property(SOURCE ${PROJECT_SOURCE_DIR}/src/backend/vulkan/shader_code.cpp ${PROJECT_SOURCE_DIR}/src/render/pipelines.cpp APPEND PROPERTY OBJECT_DEPENDS "${outputs}")
endfunction()
