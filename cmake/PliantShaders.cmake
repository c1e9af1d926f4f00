# Compiles every shader of some folders to SPIR-V as numbers, to be included as "shaders/NAME.comp.inc".
find_program(GLSLC glslc REQUIRED)

# Passes that --fast-math has a second module of, "shaders/fast/NAME.comp.inc".
set(PLIANT_FAST_SHADERS sheet_step sheet_steps spring_force list_step stage_step ring_step volume_gather volume_step
    volume_cubic volume_correct)

function(pliant_add_shaders target)
    set(include_directory ${PROJECT_BINARY_DIR}/generated)
    file(MAKE_DIRECTORY ${include_directory}/shaders/fast)
    set(outputs)
    foreach(folder IN LISTS ARGN)
        file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.comp ${folder}/*.vert ${folder}/*.frag)
        foreach(source IN LISTS sources)
            get_filename_component(name ${source} NAME)
            # The optimiser fuses products and sums before we can forbid it (with_exact_arithmetic in shader_code.hpp),
            # so that compute shaders leave optimising to the driver.
            set(optimise -O)
            if(name MATCHES "\\.comp$")
                set(optimise -O0)
            endif()
            set(variants shaders/${name})
            get_filename_component(pass ${source} NAME_WE)
            if(name MATCHES "\\.comp$" AND pass IN_LIST PLIANT_FAST_SHADERS)
                list(APPEND variants shaders/fast/${name})
            endif()
            foreach(variant IN LISTS variants)
                set(arithmetic ${optimise})
                if(variant MATCHES "/fast/")
                    set(arithmetic -O -DFAST_MATH)
                endif()
                set(output ${include_directory}/${variant}.inc)
                add_custom_command(
                    OUTPUT ${output}
                    COMMAND ${GLSLC} --target-env=vulkan1.1 ${arithmetic} -Werror -mfmt=num -MD -MF ${output}.d -MT ${output}
                            -I ${PROJECT_SOURCE_DIR}/src -I ${PROJECT_SOURCE_DIR}/src/laws -I ${folder} ${source} -o ${output}
                    DEPENDS ${source} DEPFILE ${output}.d
                    COMMENT "Compiling ${variant}" VERBATIM)
                list(APPEND outputs ${output})
            endforeach()
        endforeach()
    endforeach()
    add_custom_target(${target}_shaders DEPENDS ${outputs})
    add_dependencies(${target} ${target}_shaders)
    target_include_directories(${target} PRIVATE ${include_directory})
    # Embedded numbers are no sources of their own: rebuild what includes them when they change.
    set_property(SOURCE ${PROJECT_SOURCE_DIR}/src/backend/vulkan/shader_code.cpp APPEND PROPERTY OBJECT_DEPENDS "${outputs}")
endfunction()
