# The benchmark against other renderers (./dev peers, docs/performance/peers.md): what a scene is for all of them, and the program.
# Verified with Cycles and POV-Ray; what is written for Mitsuba, Tungsten and pbrt-v4 has been read back by tests only.
set(peers_dir ${PROJECT_SOURCE_DIR}/bench/peers)
add_library(peer_scenes STATIC EXCLUDE_FROM_ALL ${peers_dir}/make_peer_scene.cpp ${peers_dir}/plain_scene.cpp
  ${peers_dir}/tessellate.cpp ${peers_dir}/write_cycles.cpp ${peers_dir}/write_mitsuba.cpp ${peers_dir}/write_povray.cpp
  ${peers_dir}/write_tungsten.cpp)
target_include_directories(peer_scenes PUBLIC ${peers_dir})
target_link_libraries(peer_scenes PUBLIC model read write scene image PRIVATE nlohmann_json::nlohmann_json fmt::fmt)

# Measuring and the page, apart from the program, for their tests.
add_library(peer_measures STATIC EXCLUDE_FROM_ALL ${peers_dir}/measure_peers.cpp ${peers_dir}/peers_page.cpp
  ${peers_dir}/renderers.cpp ${peers_dir}/targets.cpp)
target_link_libraries(peer_measures PUBLIC peer_scenes experiments PRIVATE nlohmann_json::nlohmann_json fmt::fmt)

add_executable(peers EXCLUDE_FROM_ALL ${peers_dir}/main.cpp)
target_link_libraries(peers PRIVATE peer_measures CLI11::CLI11)
target_include_directories(peers PRIVATE ${PROJECT_SOURCE_DIR}/bench)
target_compile_definitions(peers PRIVATE NEPHROID_SOURCE_DIR="${PROJECT_SOURCE_DIR}" NEPHROID_PROGRAM="$<TARGET_FILE:nephroid>")
add_dependencies(peers nephroid)
