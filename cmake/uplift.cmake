# The table of rgb uplift coefficients: computed by tools/uplift_table.cpp during the build, linked in by the assembler.
enable_language(ASM)
set(uplift_bin ${CMAKE_BINARY_DIR}/uplift_table.bin)
add_executable(uplift_table ${PROJECT_SOURCE_DIR}/tools/uplift_table.cpp ${PROJECT_SOURCE_DIR}/src/spectrum/cie.cpp
  ${PROJECT_SOURCE_DIR}/src/spectrum/color.cpp ${PROJECT_SOURCE_DIR}/src/spectrum/dense.cpp
  ${PROJECT_SOURCE_DIR}/src/spectrum/named.cpp ${PROJECT_SOURCE_DIR}/src/spectrum/data_cie.cpp
  ${PROJECT_SOURCE_DIR}/src/spectrum/data_metals.cpp ${PROJECT_SOURCE_DIR}/src/spectrum/data_glasses.cpp
  ${PROJECT_SOURCE_DIR}/src/spectrum/data_illuminants.cpp)
target_include_directories(uplift_table PRIVATE ${PROJECT_SOURCE_DIR}/src/spectrum/include ${PROJECT_SOURCE_DIR}/src/math/include)
# Always optimised and never instrumented: the table must be the same, and be there soon, in every build.
target_compile_options(uplift_table PRIVATE -O3 -march=${NEPHROID_ARCH} -ffp-contract=off -Wno-psabi)
target_link_libraries(uplift_table PRIVATE glm::glm)
add_custom_command(OUTPUT ${uplift_bin} COMMAND uplift_table ${uplift_bin} DEPENDS uplift_table
  COMMENT "Computing the rgb uplift table" VERBATIM)
file(WRITE ${CMAKE_BINARY_DIR}/uplift_table.S
"    .section .rodata
    .global nephroid_uplift_table
    .balign 16
nephroid_uplift_table:
    .incbin \"${uplift_bin}\"
    .section .note.GNU-stack,\"\",%progbits
")
set_source_files_properties(${CMAKE_BINARY_DIR}/uplift_table.S PROPERTIES OBJECT_DEPENDS ${uplift_bin})
add_library(uplift_table_object OBJECT ${CMAKE_BINARY_DIR}/uplift_table.S)
target_sources(spectrum PRIVATE $<TARGET_OBJECTS:uplift_table_object>)
