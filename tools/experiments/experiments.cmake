# The programs that make the pages of docs/experiments (./dev experiment NAME) and docs/report (./dev report): one a folder, over
# what they share.
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
# Figures of the report that more than one page shows. Photons are drawn as `nephroid render --show-photons` draws them.
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tools/experiments/figures/*.cpp)
add_library(figures STATIC EXCLUDE_FROM_ALL ${sources})
target_link_libraries(figures PUBLIC experiments PRIVATE apps)
target_include_directories(figures PUBLIC ${PROJECT_SOURCE_DIR}/tools/experiments/figures PRIVATE ${PROJECT_SOURCE_DIR}/src)

experiment(direct_lighting)
experiment(surfaces)
experiment(photon_mapping)
experiment(report)
# Measured materials are made by the recipe of the tests of that model.
target_include_directories(experiment_surfaces PRIVATE ${PROJECT_SOURCE_DIR}/tests/model ${PROJECT_SOURCE_DIR}/tests/include)
target_link_libraries(experiment_direct_lighting PRIVATE figures)
target_link_libraries(experiment_surfaces PRIVATE figures)
target_link_libraries(experiment_photon_mapping PRIVATE figures)
target_link_libraries(experiment_report PRIVATE figures apps)
target_include_directories(experiment_report PRIVATE ${PROJECT_SOURCE_DIR}/src)  # paths are drawn as `nephroid render --replay` draws them
# A faulty basis, which the tests keep as well, is shown on that page; nothing of the renderer sees it.
target_include_directories(experiment_report PRIVATE ${PROJECT_SOURCE_DIR}/tests/include)
