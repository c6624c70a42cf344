// make_thumbnails FILE [SCENE…]: writes the table of thumbnails; with scenes, makes only their rows again, and keeps the others.
#include "read/read.h"
#include "thumbnail.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>

using namespace nephroid;
using namespace nephroid::test;

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::fputs("usage: make_thumbnails FILE [SCENE…]   scenes as in the table, e.g. gallery/cup.pbrt\n",
                   stderr);
        return 2;
    }
    std::vector<std::string> const only(argv + 2, argv + argc);
    std::vector<Row> const before = only.empty() ? std::vector<Row>() : read_table(argv[1]);
    std::vector<std::string> const names = scene_names();
    for (std::string const& name : only)
        if (!std::binary_search(names.begin(), names.end(), name))
            throw std::runtime_error("scenes/" + name + " is not there");
    std::vector<Row> rows;
    for (std::string const& name : names) {
        auto const kept =
            std::find_if(before.begin(), before.end(), [&](Row const& r) { return r.scene == name; });
        bool const asked = only.empty() || std::find(only.begin(), only.end(), name) != only.end();
        if (!asked && kept != before.end()) {
            rows.push_back(*kept);
            continue;
        }
        rows.push_back(make_row(name, thumbnail_scene(read_scene(scenes_folder() / name))));
        std::fprintf(stderr, "%-40s %2d passes, notices %.1f%%\n", name.c_str(), rows.back().passes,
                     100 * noticed(rows.back(), test_batches(), names.size()));
    }
    std::ofstream out(argv[1], std::ios::binary);
    out << table_text(rows);
    out.close();
    if (!out) throw std::runtime_error(std::string(argv[1]) + ": cannot be written");
    return 0;
} catch (std::exception const& error) {
    std::fprintf(stderr, "make_thumbnails: %s\n", error.what());
    return 4;
}
