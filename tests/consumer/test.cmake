# Installs a build of Pliant into an empty folder, then builds and runs the consumer with nothing but that.
#   cmake -DBUILD=build/release -DSOURCE=tests/consumer -DCOMPILER=c++ -DGENERATOR=Ninja -DBUILD_TYPE=Release
#         [-DFLAGS=address,undefined] -P test.cmake
# FLAGS are the sanitizers of the build, if any.
cmake_minimum_required(VERSION 3.25)

foreach(variable BUILD SOURCE COMPILER GENERATOR)
    if(NOT DEFINED ${variable})
        message(FATAL_ERROR "-D${variable}=... is missing")
    endif()
endforeach()

set(work ${BUILD}/consumer)
set(prefix ${work}/prefix)
file(REMOVE_RECURSE ${work})

function(step what)
    execute_process(COMMAND ${ARGN} TIMEOUT 300
                    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "the consumer test cannot ${what} (${result}):\n${output}")
    endif()
    message(STATUS "${what}: good")
endfunction()

set(flags)
if(FLAGS)
    set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${FLAGS})
endif()

step("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
# No hint but the prefix: what the package needs must be found by the package itself.
step("configure" ${CMAKE_COMMAND} -S ${SOURCE} -B ${work}/build -DCMAKE_PREFIX_PATH=${prefix}
     -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=${BUILD_TYPE} ${flags}
     -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
step("build" ${CMAKE_COMMAND} --build ${work}/build)
# The program of the manual, which leaves files where it runs.
set(program ${SOURCE}/../../docs/manual/own_program)
step("configure the manual's program" ${CMAKE_COMMAND} -S ${program} -B ${work}/own_program -DCMAKE_PREFIX_PATH=${prefix}
     -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=${BUILD_TYPE} ${flags}
     -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
step("build the manual's program" ${CMAKE_COMMAND} --build ${work}/own_program)
step("run the manual's program" ${CMAKE_COMMAND} -E chdir ${work}/own_program ${work}/own_program/cape)
if(NOT EXISTS ${work}/own_program/cape.ply)
    message(FATAL_ERROR "the manual's program left no cape.ply")
endif()
step("run the consumer" ${work}/build/consumer)
step("run what links the library alone" ${work}/build/alone)

find_program(tool pliant PATHS ${prefix}/bin NO_DEFAULT_PATH)
if(tool)
    step("run the installed tool" ${CMAKE_COMMAND} -E chdir ${work} ${tool} check parity)
endif()
