// Scenes look as they did: every scene of scenes/ against tests/scenes/thumbnails.tsv, in four parts that ctest runs side by side;
// and that this would notice what it is there for.
#include "read/read.h"
#include "statistics.h"
#include "thumbnail.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>

using namespace nephroid;
using namespace nephroid::test;

namespace {

std::filesystem::path table_file() {
    return std::filesystem::path(NEPHROID_SOURCE_DIR) / "tests/scenes/thumbnails.tsv";
}

/// Seeds that neither the table nor another scene has.
constexpr std::uint64_t kSeed = 77;

void check_part(std::size_t part) {
    constexpr std::size_t parts = 4;
    std::vector<Row> const rows = read_table(table_file());
    auto const names = scene_names();
    for (std::size_t i = part; i < rows.size(); i += parts) {
        Row const& row = rows[i];
        if (!std::binary_search(names.begin(), names.end(), row.scene)) continue;  // said by another test
        INFO("if scenes/", row.scene, " is meant to look different: ./dev thumbnails ", row.scene,
             ", and look at the diff");
        auto const found = batches(thumbnail_scene(read_scene(scenes_folder() / row.scene)), row.passes,
                                   kSeed, test_batches());
        for (std::string const& what : differences(row, found, rows.size())) FAIL_CHECK(what);
    }
    CHECK(rows.size() >= 14);
}

/// The row of cornell-spheres, and that scene after `change` of its text.
std::vector<std::string> said_of(std::string const& from, std::string const& to) {
    std::vector<Row> const rows = read_table(table_file());
    auto const row = std::find_if(rows.begin(), rows.end(),
                                  [](Row const& r) { return r.scene == "cornell-spheres.pbrt"; });
    REQUIRE(row != rows.end());
    std::string text;
    for (char const* name : {"cornell-spheres.pbrt", "include/cornell-room.pbrt"}) {
        std::ifstream in(scenes_folder() / name);
        std::string file{std::istreambuf_iterator<char>(in), {}};
        std::string const include = "Include \"include/cornell-room.pbrt\"";
        if (auto const at = text.find(include); at != std::string::npos)
            text.replace(at, include.size(), file);
        else
            text = file;
    }
    if (!from.empty()) {
        REQUIRE(text.find(from) != std::string::npos);
        text.replace(text.find(from), from.size(), to);
    }
    Scene scene = thumbnail_scene(read_pbrt_string(text, "changed.pbrt", scenes_folder()));
    return differences(*row, batches(std::move(scene), row->passes, kSeed + 1000, 6), rows.size());
}

}  // namespace

TEST_CASE("scenes look as they did, part 1") { check_part(0); }
TEST_CASE("scenes look as they did, part 2") { check_part(1); }
TEST_CASE("scenes look as they did, part 3") { check_part(2); }
TEST_CASE("scenes look as they did, part 4") { check_part(3); }

TEST_CASE("every scene has a row, and every row a scene") {
    std::vector<Row> const rows = read_table(table_file());
    for (std::string const& what : strangers(scene_names(), rows)) FAIL_CHECK(what);

    auto scenes = scene_names();
    scenes.push_back("zebra.pbrt");
    auto said = strangers(scenes, rows);
    REQUIRE(said.size() == 1);
    CHECK(said[0].find("scenes/zebra.pbrt has no row") == 0);
    scenes.pop_back();
    std::vector<Row> more = rows;
    more.push_back({.scene = "gone.pbrt"});
    said = strangers(scenes, more);
    REQUIRE(said.size() == 1);
    CHECK(said[0].find("a row for scenes/gone.pbrt, which is not there") != std::string::npos);
}

// Where small lights are met through water or in mirrors by chance alone, 32 passes do not make 3% sure: such scenes are a minority,
// and one that notices next to nothing would be no test.
TEST_CASE("3% of the light is noticed in most scenes, and 15% in all") {
    std::vector<Row> const rows = read_table(table_file());
    std::ptrdiff_t sharp = 0;
    for (Row const& row : rows) {
        double const share = noticed(row, 6, rows.size());
        if (share < 0.03) ++sharp;
        CHECK_MESSAGE(share < 0.15, row.scene, " notices ", share);
    }
    MESSAGE(sharp, " of ", rows.size(), " scenes notice 3%");
    CHECK(sharp * 2 > std::ssize(rows));
}

TEST_CASE("another light, and a ball elsewhere, are noticed; other samples are not") {
    CHECK(said_of("", "").empty());
    CHECK(said_of("\"zsobol\"", "\"stratified\"").empty());
    // 5% more light
    auto const light = said_of("\"float scale\" 16", "\"float scale\" 16.8");
    MESSAGE("light x 1.05: ", light.size(), " of 54 numbers are off");
    CHECK(!light.empty());
    // 40 mm, a fifth of the silver ball's width
    auto const ball = said_of("Translate 395 100 370", "Translate 355 100 370");
    MESSAGE("a ball 40 mm aside: ", ball.size(), " of 54 numbers are off");
    CHECK(!ball.empty());
}

TEST_CASE("each scene says in its first lines what it shows") {
    std::vector<std::string> files = scene_names();
    for (auto const& entry : std::filesystem::recursive_directory_iterator(scenes_folder() / "include"))
        if (entry.is_regular_file())
            files.push_back(entry.path().lexically_relative(scenes_folder()).generic_string());
    for (std::string const& file : files) {
        std::ifstream in(scenes_folder() / file);
        std::string line, comment;
        // In .ray files a comment follows the line that names the format.
        bool const ray = file.ends_with(".ray");
        if (ray) std::getline(in, line), std::getline(in >> std::ws, line), comment = line;
        auto const goes_on = [&] {
            return line.starts_with(ray ? "//" : "#") || (ray && line.starts_with("  "));
        };
        if (ray && !line.starts_with("/*") && !goes_on()) comment.clear();
        while (std::getline(in, line) && goes_on()) comment += line;
        CHECK_MESSAGE(comment.size() >= 60, file, ": begin with a comment that says what there is to see");
    }
}

TEST_CASE("a table that is broken is refused with its line") {
    auto const file = std::filesystem::temp_directory_path() / "nephroid-thumbnails.tsv";
    auto const rows = read_table(table_file());
    std::string const text = table_text(rows);
    std::ofstream(file) << text;
    CHECK(table_text(read_table(file)) == text);
    for (std::string const& bad :
         {std::string("x.pbrt\t4\n"),
          std::string("x.pbrt\t0") + text.substr(text.find('\t', text.size() - 900))}) {
        std::ofstream(file) << text << bad;
        CHECK_THROWS_WITH_AS(read_table(file),
                             doctest::Contains(("tsv:" + std::to_string(rows.size() + 3)).c_str()),
                             std::runtime_error);
    }
    std::filesystem::remove(file);
}
