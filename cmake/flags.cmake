# One place for compiler flags. Results must not depend on the build type: no -ffast-math, no contraction of a*b+c,
# so that release, debug and sanitizer builds make the same bits.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g")

add_library(nephroid_flags INTERFACE)
target_compile_options(nephroid_flags INTERFACE
  -march=${NEPHROID_ARCH} -ffp-contract=off -fno-math-errno -fno-trapping-math
  -Wall -Wextra -Wpedantic -Wshadow -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(nephroid_flags INTERFACE -Wno-psabi -Wno-restrict)  # g++ 12 sees overlaps in std::string that are none
endif()
# The sanitizer presets compile six files of a room as one (CMAKE_UNITY_BUILD): instrumented headers are slow to compile, and a
# name that two files of a room define each for itself shows up there. That every file includes what it needs, the others show.
if(NEPHROID_SANITIZE)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(nephroid_flags INTERFACE -Wno-maybe-uninitialized)  # instrumented variants look uninitialised to g++ 12
  endif()
  target_compile_options(nephroid_flags INTERFACE -fsanitize=${NEPHROID_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(nephroid_flags INTERFACE -fsanitize=${NEPHROID_SANITIZE})
endif()
if(NEPHROID_COVERAGE)
  target_compile_options(nephroid_flags INTERFACE --coverage)
  target_link_options(nephroid_flags INTERFACE --coverage)
endif()
