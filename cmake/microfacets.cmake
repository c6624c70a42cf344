# The tables of microfacet albedos: computed by tools/microfacet_table.cpp during the build, linked in by the assembler.
set(microfacet_bin ${CMAKE_BINARY_DIR}/microfacet_table.bin)
add_executable(microfacet_table ${PROJECT_SOURCE_DIR}/tools/microfacet_table.cpp ${PROJECT_SOURCE_DIR}/src/model/microfacet.cpp
  ${PROJECT_SOURCE_DIR}/src/model/microfacet_beckmann.cpp ${PROJECT_SOURCE_DIR}/src/model/microfacet_blinn.cpp)
foreach(room model scene sampling spectrum math)
  target_include_directories(microfacet_table PRIVATE ${PROJECT_SOURCE_DIR}/src/${room}/include)
endforeach()
# Always optimised and never instrumented, as the uplift table.
target_compile_options(microfacet_table PRIVATE -O3 -march=${NEPHROID_ARCH} -ffp-contract=off -Wno-psabi)
target_link_libraries(microfacet_table PRIVATE glm::glm)
add_custom_command(OUTPUT ${microfacet_bin} COMMAND microfacet_table ${microfacet_bin} DEPENDS microfacet_table
  COMMENT "Computing the table of microfacet albedos" VERBATIM)
file(WRITE ${CMAKE_BINARY_DIR}/microfacet_table.S
"    .section .rodata
    .global nephroid_microfacet_table
    .balign 16
nephroid_microfacet_table:
    .incbin \"${microfacet_bin}\"
    .section .note.GNU-stack,\"\",%progbits
")
set_source_files_properties(${CMAKE_BINARY_DIR}/microfacet_table.S PROPERTIES OBJECT_DEPENDS ${microfacet_bin})
add_library(microfacet_table_object OBJECT ${CMAKE_BINARY_DIR}/microfacet_table.S)
target_sources(model PRIVATE $<TARGET_OBJECTS:microfacet_table_object>)
