# Compiles every shader of some folders to SPIR-V as numbers, to be included as "shaders/NAME.comp.inc".
find_program(GLSLC glslc REQUIRED)

function(pliant_add_shaders target)
    set(include_directory ${PROJECT_BINARY_DIR}/generated)
    file(MAKE_DIRECTORY ${include_directory}/shaders)
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
            set(output ${include_directory}/shaders/${name}.inc)
            add_custom_command(
                OUTPUT ${output}
                COMMAND ${GLSLC} --target-env=vulkan1.2 ${optimise} -Werror -mfmt=num -MD -MF ${output}.d -MT ${output}
                        -I ${PROJECT_SOURCE_DIR}/src -I ${PROJECT_SOURCE_DIR}/src/laws -I ${folder} ${source} -o ${output}
                DEPENDS ${source} DEPFILE ${output}.d
                COMMENT "Compiling shader ${name}" VERBATIM)
            list(APPEND outputs ${output})
        endforeach()
    endforeach()
    add_custom_target(${target}_shaders DEPENDS ${outputs})
    add_dependencies(${target} ${target}_shaders)
    target_include_directories(${target} PRIVATE ${include_directory})
    # Embedded numbers are no sources of their own: rebuild what includes them when they change.
    set_property(SOURCE ${PROJECT_SOURCE_DIR}/src/backend/vulkan/shader_code.cpp APPEND PROPERTY OBJECT_DEPENDS "${outputs}")
endfunction()
