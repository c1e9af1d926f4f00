# One of the project's libraries. It is compiled once, as the objects NAME_objects, from which NAME is made: static or, with
# BUILD_SHARED_LIBS, shared. Nothing is visible outside but what a header marks (include/pliant/api.hpp).
#   pliant_library(NAME SOURCES ... [NEEDS other libraries of the project] [LINKS ...])
# Users link pliant::pliant, pliant::io, pliant::render.
function(pliant_library name)
    cmake_parse_arguments(PARSE_ARGV 1 library "" "" "SOURCES;NEEDS;LINKS")
    add_library(${name}_objects OBJECT ${library_SOURCES})
    pliant_set_flags(${name}_objects)
    set_target_properties(${name}_objects PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    target_include_directories(${name}_objects PRIVATE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
    target_include_directories(${name}_objects SYSTEM PRIVATE ${Vulkan_INCLUDE_DIRS})
    target_link_libraries(${name}_objects PRIVATE ${library_LINKS})

    string(REGEX REPLACE "^pliant_" "" short ${name})
    add_library(${name} $<TARGET_OBJECTS:${name}_objects>)
    add_library(pliant::${short} ALIAS ${name})
    set_target_properties(${name} PROPERTIES EXPORT_NAME ${short} LINKER_LANGUAGE CXX
        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    pliant_set_flags(${name})
    target_compile_features(${name} PUBLIC cxx_std_20)
    target_include_directories(${name} PUBLIC
        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(${name} PUBLIC ${library_NEEDS} PRIVATE ${library_LINKS})
endfunction()
