# The programs that make the pages of docs/experiments (./dev experiment NAME): one a folder, over what they share.
add_library(experiments STATIC EXCLUDE_FROM_ALL)
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tools/experiments/*.cpp)
target_sources(experiments PRIVATE ${sources})
target_include_directories(experiments PUBLIC ${PROJECT_SOURCE_DIR}/tools/experiments)
target_compile_definitions(experiments PRIVATE NEPHROID_SCENES="${PROJECT_SOURCE_DIR}/scenes")
target_link_libraries(experiments PUBLIC render read film image fmt::fmt)

function(experiment name)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tools/experiments/${name}/*.cpp)
  add_executable(experiment_${name} EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(experiment_${name} PRIVATE experiments)
endfunction()
experiment(direct_lighting)
experiment(surfaces)
experiment(photon_mapping)
# Measured materials are made by the recipe of the tests of that model.
target_include_directories(experiment_surfaces PRIVATE ${PROJECT_SOURCE_DIR}/tests/model ${PROJECT_SOURCE_DIR}/tests/include)
# Photons are drawn as `nephroid render --show-photons` draws them.
target_link_libraries(experiment_photon_mapping PRIVATE apps)
target_include_directories(experiment_photon_mapping PRIVATE ${PROJECT_SOURCE_DIR}/src)
