# Tables that a tool of ours computes during the build and that the assembler links into a room.
#
#   built_table(NAME room "What is computed" SOURCES … ROOMS …)
#
# runs tools/NAME.cpp, built from it, from SOURCES below src/ and with the includes of ROOMS, as `NAME NAME.bin`. Its bytes are the
# symbol nephroid_NAME.
enable_language(ASM)

function(built_table name room what)
  cmake_parse_arguments(PARSE_ARGV 3 table "" "" "SOURCES;ROOMS")
  set(bin ${CMAKE_BINARY_DIR}/${name}.bin)
  list(TRANSFORM table_SOURCES PREPEND ${PROJECT_SOURCE_DIR}/src/)
  add_executable(${name} ${PROJECT_SOURCE_DIR}/tools/${name}.cpp ${table_SOURCES})
  foreach(included IN LISTS table_ROOMS)
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src/${included}/include)
  endforeach()
  # Always optimised and never instrumented: the table must be the same, and be there soon, in every build.
  target_compile_options(${name} PRIVATE -O3 -march=${NEPHROID_ARCH} -ffp-contract=off -Wno-psabi)
  target_link_libraries(${name} PRIVATE glm::glm)
  add_custom_command(OUTPUT ${bin} COMMAND ${name} ${bin} DEPENDS ${name} COMMENT "Computing ${what}" VERBATIM)
  file(WRITE ${CMAKE_BINARY_DIR}/${name}.S
"    .section .rodata
    .global nephroid_${name}
    .balign 16
nephroid_${name}:
    .incbin \"${bin}\"
    .section .note.GNU-stack,\"\",%progbits
")
  set_source_files_properties(${CMAKE_BINARY_DIR}/${name}.S PROPERTIES OBJECT_DEPENDS ${bin})
  add_library(${name}_object OBJECT ${CMAKE_BINARY_DIR}/${name}.S)
  target_sources(${room} PRIVATE $<TARGET_OBJECTS:${name}_object>)
endfunction()
