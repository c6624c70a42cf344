# The directional albedos of microfacets and sheen: computed by tools/layer_albedos.cpp during the build, linked in by the assembler.
set(layer_albedos_bin ${CMAKE_BINARY_DIR}/layer_albedos.bin)
add_executable(layer_albedos ${PROJECT_SOURCE_DIR}/tools/layer_albedos.cpp)
target_include_directories(layer_albedos PRIVATE ${PROJECT_SOURCE_DIR}/src/model/include ${PROJECT_SOURCE_DIR}/src/math/include)
# Always optimised and never instrumented: the table must be the same, and be there soon, in every build.
target_compile_options(layer_albedos PRIVATE -O3 -march=${NEPHROID_ARCH} -ffp-contract=off -Wno-psabi)
target_link_libraries(layer_albedos PRIVATE glm::glm)
add_custom_command(OUTPUT ${layer_albedos_bin} COMMAND layer_albedos ${layer_albedos_bin} DEPENDS layer_albedos
  COMMENT "Computing the albedos of layers" VERBATIM)
file(WRITE ${CMAKE_BINARY_DIR}/layer_albedos.S
"    .section .rodata
    .global nephroid_layer_albedos
    .balign 16
nephroid_layer_albedos:
    .incbin \"${layer_albedos_bin}\"
    .section .note.GNU-stack,\"\",%progbits
")
set_source_files_properties(${CMAKE_BINARY_DIR}/layer_albedos.S PROPERTIES OBJECT_DEPENDS ${layer_albedos_bin})
add_library(layer_albedos_object OBJECT ${CMAKE_BINARY_DIR}/layer_albedos.S)
target_sources(model PRIVATE $<TARGET_OBJECTS:layer_albedos_object>)
