// Every scene of scenes/ at 64 x 48 pixels, put into 54 numbers that a table remembers (tests/scenes/thumbnails.tsv).
//
// A thumbnail is rendered in batches: renders of a few passes under seeds of their own, by the scene's integrator, with few photons.
// Of each batch 54 numbers are taken; the table holds their mean and standard deviation over batches of the table's own seeds. A
// scene is held against its row by what chance allows both: nothing is said of samples, only of the distribution that they have.
//
// Numbers are taken of y = x / (1 + x), x being the batch's linear rgb: bounded, so that light that is found by chance alone
// leaves no heavy tail, and increasing, so that a brighter scene is brighter. The mean of such a y depends on the noise as well:
// hence the same passes in every batch, of the table and of the test.
#pragma once

#include "scene/scene.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::test {

/// Means of red, green, blue; of 8 x 6 fields' luminance, row by row; 10th, 50th and 90th percentile of 4 x 4 blocks' luminance.
inline constexpr std::size_t kNumbers = 54;
inline constexpr std::size_t kFirstField = 3, kFirstPercentile = 51;
using Numbers = std::array<double, kNumbers>;

struct Row {
    std::string scene;  // relative to scenes/, with its extension
    int passes = 0;     // of a batch
    Numbers mean{}, deviation{};
};

/// Batches behind a row of the table, and those of a test.
inline constexpr int kTableBatches = 16;
int test_batches();

std::filesystem::path scenes_folder();
/// All scenes below scenes/, sorted; scenes/include holds parts of scenes, not scenes.
std::vector<std::string> scene_names();

/// The scene as it is for thumbnails: small, and with few photons.
Scene thumbnail_scene(Scene scene);
/// One batch: passes [0, passes) under `seed`.
std::vector<Numbers> batches(Scene scene, int passes, std::uint64_t first_seed, int count);

/// The row of a scene: as many passes as make the mean luminance sure enough, by doubling.
Row make_row(std::string const& name, Scene scene);

/// What differs, in words; empty when nothing does. `tests` is how many rows the table has: they share the significance of 1%.
std::vector<std::string> differences(Row const& row, std::vector<Numbers> const& found, std::size_t rows);
/// The smallest change of all light, as a share, that would be noticed.
double noticed(Row const& row, int found_batches, std::size_t rows);

/// Rows of a table, in its order. Throws std::runtime_error for a line that is none.
std::vector<Row> read_table(std::filesystem::path const& file);
std::string table_text(std::vector<Row> const& rows);

/// Scenes without a row, and rows without a scene, with what to do.
std::vector<std::string> strangers(std::vector<std::string> const& scenes, std::vector<Row> const& rows);

}  // namespace nephroid::test
