# The table behind closed forms of coats: computed by tools/coat_table.cpp during the build, linked in by the assembler.
set(coat_bin ${CMAKE_BINARY_DIR}/coat_table.bin)
file(GLOB coat_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/model/microfacet.cpp
  ${PROJECT_SOURCE_DIR}/src/model/microfacet_b*.cpp)
add_executable(coat_table ${PROJECT_SOURCE_DIR}/tools/coat_table.cpp ${coat_sources})
foreach(room model scene sampling spectrum math)
  target_include_directories(coat_table PRIVATE ${PROJECT_SOURCE_DIR}/src/${room}/include)
endforeach()
# Always optimised and never instrumented: the table must be the same, and be there soon, in every build.
target_compile_options(coat_table PRIVATE -O3 -march=${NEPHROID_ARCH} -ffp-contract=off -Wno-psabi)
target_link_libraries(coat_table PRIVATE glm::glm)
add_custom_command(OUTPUT ${coat_bin} COMMAND coat_table ${coat_bin} DEPENDS coat_table
  COMMENT "Computing the table of coats" VERBATIM)
file(WRITE ${CMAKE_BINARY_DIR}/coat_table.S
"    .section .rodata
    .global nephroid_coat_table
    .balign 16
nephroid_coat_table:
    .incbin \"${coat_bin}\"
    .section .note.GNU-stack,\"\",%progbits
")
set_source_files_properties(${CMAKE_BINARY_DIR}/coat_table.S PROPERTIES OBJECT_DEPENDS ${coat_bin})
add_library(coat_table_object OBJECT ${CMAKE_BINARY_DIR}/coat_table.S)
target_sources(model PRIVATE $<TARGET_OBJECTS:coat_table_object>)
