#include "thumbnail.h"

#include "film/develop.h"
#include "read/read.h"
#include "render/render.h"
#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace nephroid::test {

namespace {

constexpr int kWidth = 64, kHeight = 48, kAcross = 8, kDown = 6, kBlock = 4;
constexpr double kFieldPixels = (kWidth / kAcross) * (kHeight / kDown);
constexpr int kPhotons =
    20000;  // of a pass, into each map: as many as pixels would be few, as many as some scenes want slow

/// "red", "row.column" of a field, "10%" …
std::string number_name(std::size_t i) {
    if (i < kFirstField) return std::array{"red", "green", "blue"}[i];
    if (i >= kFirstPercentile) return std::array{"10%", "50%", "90%"}[i - kFirstPercentile];
    return std::to_string((i - kFirstField) / kAcross + 1) + "." +
           std::to_string((i - kFirstField) % kAcross + 1);
}

double shown(double x) { return x <= 0 ? 0 : x / (1 + x); }

Numbers numbers(Image const& picture) {
    Numbers n{};
    std::vector<double> blocks(static_cast<std::size_t>((kWidth / kBlock) * (kHeight / kBlock)));
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            std::array<double, 3> rgb{};
            for (int c = 0; c < 3; ++c)
                rgb[static_cast<std::size_t>(c)] = shown(static_cast<double>(picture.get(x, y, c)));
            double const luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
            for (std::size_t c = 0; c < 3; ++c) n[c] += rgb[c] / (kWidth * kHeight);
            n[kFirstField + static_cast<std::size_t>(y / (kHeight / kDown) * kAcross +
                                                     x / (kWidth / kAcross))] += luminance / kFieldPixels;
            blocks[static_cast<std::size_t>(y / kBlock * (kWidth / kBlock) + x / kBlock)] +=
                luminance / (kBlock * kBlock);
        }
    std::sort(blocks.begin(), blocks.end());
    for (std::size_t i = 0; i < 3; ++i)
        n[kFirstPercentile + i] = blocks[(blocks.size() - 1) * (1 + 4 * i) / 10];
    return n;
}

/// Mean and standard deviation of each number.
std::array<Mean, kNumbers> over(std::vector<Numbers> const& found) {
    std::array<Mean, kNumbers> means;
    for (Numbers const& batch : found)
        for (std::size_t i = 0; i < kNumbers; ++i) means[i].add(batch[i]);
    return means;
}

/// What a number may be off. Deviations are known from the table's batches alone, so Student's law has as many degrees of freedom.
/// Light that is met once in more batches than the table has is in no deviation: one pixel of a field may be lit by it, in one batch.
/// (Dispersed light of prism.pbrt's lamp did just that, in 2 of 6 batches: 0.0195 for 0.0151 +- 0.00014.)
/// The floor is what another compiler's rounding may do to a path, and the four digits of the table.
double allowed(Row const& row, std::size_t i, std::size_t found_batches, std::size_t rows) {
    static std::map<std::size_t, double> known;
    auto const at = known.find(rows);
    double const t = at != known.end() ? at->second
                                       : known[rows] = student_quantile(
                                             sidak(static_cast<int>(rows * kNumbers)), kTableBatches - 1);
    bool const field = i >= kFirstField && i < kFirstPercentile;
    double const lone = field ? 1.0 / (kFieldPixels * static_cast<double>(found_batches)) : 0;
    return t * row.deviation[i] * std::sqrt(1.0 / static_cast<double>(found_batches) + 1.0 / kTableBatches) +
           lone + 0.002 * row.mean[i] + 0.0002;
}

}  // namespace

int test_batches() { return kSanitizerShare > 1 ? 1 : full() ? 16 : 6; }

std::filesystem::path scenes_folder() { return std::filesystem::path(NEPHROID_SOURCE_DIR) / "scenes"; }

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (auto const& entry : std::filesystem::recursive_directory_iterator(scenes_folder())) {
        auto const name = entry.path().lexically_relative(scenes_folder());
        bool const scene = entry.path().extension() == ".pbrt" || entry.path().extension() == ".ray";
        if (entry.is_regular_file() && scene && *name.begin() != "include")
            names.push_back(name.generic_string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

Scene thumbnail_scene(Scene scene) {
    Settings& s = scene.settings;
    s.film.resolution = {kWidth, kHeight};
    s.film.crop.reset();
    s.film.aovs = false;
    auto const counted = [](PhotonShooting& p) { p.global_paths = p.caustic_paths = kPhotons; };
    if (auto* p = std::get_if<PhotonMapIntegrator>(&s.integrator)) {
        counted(p->shooting);
        p->passes = 1;
    }
    if (auto* p = std::get_if<SppmIntegrator>(&s.integrator)) counted(p->shooting);
    return scene;
}

std::vector<Numbers> batches(Scene scene, int passes, std::uint64_t first_seed, int count) {
    Settings s = scene.settings;
    // Maps are made in one pass, which has all the samples.
    if (std::holds_alternative<PhotonMapIntegrator>(s.integrator)) s.spp = passes, passes = 1;
    World const world = compile(std::move(scene));
    std::vector<Numbers> found;
    for (int i = 0; i < count; ++i) {
        s.seed = first_seed + static_cast<std::uint64_t>(i);
        RenderJob const job(world, s);
        Film film = job.make_film();
        RenderControl control;
        control.passes = {0, static_cast<std::uint64_t>(passes)};
        control.threads = 2;
        if (render(job, control, film).end != RenderEnd::Complete || film.tainted())
            throw std::runtime_error("a thumbnail has samples or rays that are not numbers");
        found.push_back(numbers(develop(film)));
    }
    return found;
}

Row make_row(std::string const& name, Scene scene) {
    constexpr int most = 32;
    constexpr double sure = 0.025;  // of all light, with room to 3%
    for (int passes = 4;; passes *= 2) {
        Row row{.scene = name, .passes = passes};
        auto const means = over(batches(scene, passes, 1000000, kTableBatches));
        for (std::size_t i = 0; i < kNumbers; ++i) {
            row.mean[i] = means[i].mean();
            row.deviation[i] = std::sqrt(means[i].variance());
        }
        if (passes >= most || noticed(row, 6, 100) <= sure) return row;
    }
}

std::vector<std::string> differences(Row const& row, std::vector<Numbers> const& found, std::size_t rows) {
    std::vector<std::string> said;
    auto const means = over(found);
    for (std::size_t i = 0; i < kNumbers; ++i) {
        double const most = allowed(row, i, found.size(), rows), off = means[i].mean() - row.mean[i];
        if (std::abs(off) <= most) continue;
        std::array<char, 200> text{};
        std::snprintf(text.data(), text.size(), "%s: %s is %.4g, the table has %.4g; chance allows %.2g",
                      row.scene.c_str(), number_name(i).c_str(), means[i].mean(), row.mean[i], most);
        said.emplace_back(text.data());
    }
    return said;
}

double noticed(Row const& row, int found_batches, std::size_t rows) {
    // y = x / (1 + x): the share d of x is d (1 - y) of y, for an even picture.
    double least = 1;
    for (std::size_t i = 0; i < kFirstField; ++i)
        least = std::min(least, allowed(row, i, static_cast<std::size_t>(found_batches), rows) /
                                    std::max(1e-9, row.mean[i] * (1 - row.mean[i])));
    return least;
}

std::vector<Row> read_table(std::filesystem::path const& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file.string() + ": cannot be read; ./dev thumbnails makes it");
    std::vector<Row> rows;
    std::string line;
    for (int at = 1; std::getline(in, line); ++at) {
        if (line.starts_with('#')) continue;
        std::istringstream words(line);
        Row row;
        bool good = static_cast<bool>(words >> row.scene >> row.passes) && row.passes > 0;
        for (std::size_t i = 0; good && i < kNumbers; ++i) {
            char slash = 0;
            good = static_cast<bool>(words >> row.mean[i] >> slash >> row.deviation[i]) && slash == '/' &&
                   row.deviation[i] >= 0;
        }
        std::string more;
        if (!good || words >> more)
            throw std::runtime_error(
                file.string() + ":" + std::to_string(at) +
                ": expected scene, passes and 54 times mean/deviation; ./dev thumbnails");
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string table_text(std::vector<Row> const& rows) {
    std::string out =
        "# Thumbnails of all scenes, made by ./dev thumbnails: mean/deviation over 16 batches of so many "
        "passes; see "
        "tests/thumbnails/thumbnail.h\n# scene\tpasses";
    for (std::size_t i = 0; i < kNumbers; ++i) out += "\t" + number_name(i);
    out += '\n';
    for (Row const& row : rows) {
        out += row.scene + '\t' + std::to_string(row.passes);
        for (std::size_t i = 0; i < kNumbers; ++i) {
            std::array<char, 60> text{};
            std::snprintf(text.data(), text.size(), "\t%.4f/%.5f", row.mean[i], row.deviation[i]);
            out += text.data();
        }
        out += '\n';
    }
    return out;
}

std::vector<std::string> strangers(std::vector<std::string> const& scenes, std::vector<Row> const& rows) {
    std::vector<std::string> said;
    std::multiset<std::string> known;
    for (Row const& row : rows) known.insert(row.scene);
    for (std::string const& scene : scenes)
        if (known.count(scene) != 1)
            said.push_back("scenes/" + scene +
                           (known.count(scene) == 0 ? " has no row" : " has more than one row") +
                           " in tests/scenes/thumbnails.tsv: run ./dev thumbnails, and look at the diff");
    for (std::string const& scene : known)
        if (!std::binary_search(scenes.begin(), scenes.end(), scene))
            said.push_back("tests/scenes/thumbnails.tsv has a row for scenes/" + scene +
                           ", which is not there: run ./dev thumbnails, and look at the diff");
    return said;
}

}  // namespace nephroid::test
