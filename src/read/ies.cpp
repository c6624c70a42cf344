#include "ies.h"

#include "number.h"
#include "shown.h"

#include "math/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace nephroid {

namespace {

constexpr std::int64_t kMostAngles = 10'000;
constexpr std::int64_t kMostValues = 4'000'000;  // every quarter of a degree would be 10^6

constexpr std::string_view kDosBlanks = " \t\r\v\f\x1a";  // with the end of file of DOS
std::string_view trimmed(std::string_view s) {
    s.remove_prefix(std::min(s.find_first_not_of(kDosBlanks), s.size()));
    return s.substr(0, s.find_last_not_of(kDosBlanks) + 1);
}
bool same_letters(std::string_view a, std::string_view upper) {
    return a.size() == upper.size() && std::equal(a.begin(), a.end(), upper.begin(), [](char x, char y) {
               return (x >= 'a' && x <= 'z' ? static_cast<char>(x - 'a' + 'A') : x) == y;
           });
}

class Reader {
  public:
    Reader(std::string_view text, std::string const& name) : rest_(text), name_(name) {}

    IesFile file() {
        std::string_view const tilt = label_lines();
        if (same_letters(tilt, "INCLUDE")) {
            skip_tilt();
        } else if (!same_letters(tilt, "NONE")) {
            fail("TILT=" + shown(tilt, 40) +
                 " names another file, which is not read; write TILT=NONE where the lamp is not tilted");
        }
        numbers();
        return std::move(file_);
    }

  private:
    // --- lines and words ----------------------------------------------------------------------------------------------
    [[noreturn]] void fail(std::string const& message, ErrorKind kind = ErrorKind::Input) const {
        throw Error(kind, name_ + ":" + std::to_string(line_) + ": " + message);
    }
    void note(std::string const& text) {
        file_.notes.push_back(name_ + ":" + std::to_string(line_) + ": " + text);
    }
    std::optional<std::string_view> next_line() {
        std::optional<std::string_view> line;
        if (rest_.empty()) return line;
        ++line_;
        line = rest_.substr(0, rest_.find('\n'));
        rest_.remove_prefix(std::min(line->size() + 1, rest_.size()));
        return line;
    }
    /// Up to the line "TILT=…": what it says.
    std::string_view label_lines() {
        while (auto const line = next_line()) {
            auto const words = trimmed(*line);
            auto const equals = words.find('=');
            if (equals != std::string_view::npos && same_letters(trimmed(words.substr(0, equals)), "TILT"))
                return trimmed(words.substr(equals + 1));
        }
        fail("there is no line \"TILT=\"; is it an IES file?");
    }
    /// Nothing at the end of the file.
    std::optional<std::string_view> next_word() {
        constexpr std::string_view kBetween = " \t\r\v\f\x1a,";
        std::optional<std::string_view> result;
        while (true) {
            line_rest_.remove_prefix(std::min(line_rest_.find_first_not_of(kBetween), line_rest_.size()));
            if (!line_rest_.empty()) break;
            auto const line = next_line();
            if (!line) return result;
            line_rest_ = *line;
        }
        result = line_rest_.substr(0, line_rest_.find_first_of(kBetween));
        line_rest_.remove_prefix(result->size());
        return result;
    }
    std::string_view word(std::string const& what) {
        auto const w = next_word();
        if (!w) fail("the file ends where " + what + " should be; it is cut off");
        return *w;
    }
    float number(std::string const& what) { return number(what, parse_float); }
    template <class T>
    T number(std::string const& what, std::optional<T> parse(std::string_view)) {
        auto const w = word(what);
        auto const v = parse(w);
        if (!v) fail("\"" + shown(w, 40) + "\" is not a finite number; here should be " + what);
        return *v;
    }
    std::int64_t count(std::string const& what, std::int64_t least, std::int64_t most) {
        // Some programs write counts as 37.0.
        auto const v = static_cast<double>(number(what));
        if (v != std::floor(v) || v < static_cast<double>(least))
            fail(what + " must be a whole number from " + std::to_string(least) + " on");
        if (v > static_cast<double>(most))
            fail(what + " is more than is read (" + std::to_string(most) + "); thin the table out",
                 ErrorKind::Limit);
        return static_cast<std::int64_t>(v);
    }
    int choice(std::string const& what, int most) {
        float const v = number(what);
        for (int i = 1; i <= most; ++i)
            if (v == static_cast<float>(i)) return i;
        fail(what + " must be a whole number from 1 to " + std::to_string(most));
    }
    float factor(std::string const& what) {
        float const v = number(what);
        if (!(v > 0)) fail(what + " must be above 0");
        return v;
    }

    // --- the parts ----------------------------------------------------------------------------------------------------
    void skip_tilt() {
        number("the lamp's position in the luminaire");
        std::int64_t const n = count("the number of tilt angles", 0, kMostAngles);
        bool changes = false;
        for (std::int64_t i = 0; i < n; ++i) number("a tilt angle");
        for (std::int64_t i = 0; i < n; ++i) changes |= number("a tilt factor") != 1;
        if (changes) note("the factors of a tilted lamp (TILT=INCLUDE) are not applied");
    }

    /// In double: degrees in a float do not reach every angle.
    std::vector<double> angles(std::int64_t n, std::string const& what, double most) {
        std::vector<double> r;
        for (std::int64_t i = 0; i < n; ++i) {
            double const a = number(what, parse_double);
            if (a < 0 || a > most)
                fail(what + " is outside 0 to " + std::to_string(static_cast<int>(most)) +
                     " degrees; of photometric type C none can be");
            if (!r.empty() && !(a > r.back())) fail(what + " does not increase; sort the table");
            r.push_back(a);
        }
        return r;
    }

    void numbers() {
        // What the intensities are of is known already: they are candela, whatever the lamps gave (-1: not measured apart).
        number("the number of lamps");
        number("the lumens of a lamp");
        float scale = factor("the candela multiplier");
        std::int64_t const n_vertical = count("the number of vertical angles", 2, kMostAngles);
        std::int64_t const n_horizontal = count("the number of horizontal angles", 1, kMostAngles);
        if (n_vertical * n_horizontal > kMostValues)
            fail(std::to_string(n_vertical) + " x " + std::to_string(n_horizontal) +
                     " intensities are more than are read (" + std::to_string(kMostValues) +
                     "); thin the table out",
                 ErrorKind::Limit);
        int const type = choice("the photometric type", 3);
        if (type != 1)
            fail(std::string("photometric type ") + (type == 2 ? "B" : "A") +
                 " is not read; convert the file to type C");
        choice("the unit of lengths", 2);
        for (char const* const what :
             {"the width of the opening", "the length of the opening", "the height of the opening"})
            number(what);  // the light is a point
        scale *= factor("the ballast factor");
        float const lamp_factor = number("the ballast-lamp photometric factor");
        if (lamp_factor < 0) fail("the ballast-lamp photometric factor must not be negative");
        if (lamp_factor == 0) note("a ballast-lamp photometric factor of 0 counts as not given");
        if (lamp_factor > 0) scale *= lamp_factor;
        number("the input watts");
        if (!std::isfinite(scale) || !(scale > 0)) fail("the factors of the candela are beyond all numbers");

        auto const vertical = angles(n_vertical, "a vertical angle", 180);
        auto const horizontal = angles(n_horizontal, "a horizontal angle", 360);
        std::vector<float> candela;
        float greatest = 0;
        for (std::int64_t i = 0; i < n_vertical * n_horizontal; ++i) {
            float const v = number("intensity " + std::to_string(i + 1) + " of " +
                                   std::to_string(n_vertical * n_horizontal));
            if (v < 0) fail("an intensity is negative; replace it by 0 or more");
            candela.push_back(v * scale);
            if (!std::isfinite(candela.back())) fail("an intensity times its factors is beyond all numbers");
            greatest = std::max(greatest, candela.back());
        }
        if (greatest == 0) note("all intensities are 0: the light is dark");
        unfold(vertical, horizontal, candela);
        if (next_word()) note("what follows the intensities was left out");
    }

    // --- symmetry -------------------------------------------------------------------------------------------------------
    struct Plane {
        double angle;  // degrees
        std::size_t column;
    };
    /// All planes that the file's planes stand for.
    std::vector<Plane> planes(std::vector<double> const& horizontal) {
        std::vector<Plane> r;
        for (std::size_t i = 0; i < horizontal.size(); ++i) r.push_back({horizontal[i], i});
        auto const mirror = [&](double sum) {
            for (std::size_t i = 0, n = r.size(); i < n; ++i)
                r.push_back({std::fmod(sum - r[i].angle + 360, 360), r[i].column});
        };
        auto const is = [](double angle, double wanted) { return std::abs(angle - wanted) < 1e-3; };
        double const first = horizontal.front();
        double const last = horizontal.back();
        if (horizontal.size() == 1 || (is(first, 0) && is(last, 360))) return r;
        if (is(first, 0) && is(last, 90)) {
            mirror(180), mirror(360);
        } else if (is(first, 0) && is(last, 180)) {
            mirror(360);
        } else if (is(first, 90) && is(last, 270)) {
            mirror(180);
        } else if (is(first, 0) && last > 180) {
            note("the horizontal angles end before 360: the first plane closes the circle");
        } else {
            fail(
                "horizontal angles must be 0 alone, or go from 0 to 90, 180 or 360, or from 90 to 270; not "
                "from " +
                std::to_string(first) + " to " + std::to_string(last));
        }
        return r;
    }

    void unfold(std::vector<double> const& vertical, std::vector<double> const& horizontal,
                std::vector<float> const& candela) {
        constexpr double kDegree = std::numbers::pi / 180;
        IntensityTable& t = file_.table;
        for (double const a : vertical) {
            auto const angle = std::min(static_cast<float>(a * kDegree), std::numbers::pi_v<float>);
            if (!t.vertical.empty() && !(angle > t.vertical.back()))
                fail("two vertical angles are too close to tell apart; leave one out");
            t.vertical.push_back(angle);
        }
        auto const n = vertical.size();
        auto all = planes(horizontal);
        std::stable_sort(all.begin(), all.end(),
                         [](Plane const& a, Plane const& b) { return a.angle < b.angle; });
        auto const append = [&](float angle, Plane const& a, Plane const& b, float share) {
            if (!t.horizontal.empty() && !(angle > t.horizontal.back())) return;
            t.horizontal.push_back(angle);
            for (std::size_t i = 0; i < n; ++i) {
                float const here = candela[a.column * n + i];
                t.candela.push_back(here + share * (candela[b.column * n + i] - here));
            }
        };
        // 0 and a full turn are one plane: one of the file's, or between its last and its first.
        Plane const& first = all.front();
        Plane const& last = all.back();
        double const gap = first.angle + 360 - last.angle;
        auto const share = static_cast<float>(gap > 0 ? (360 - last.angle) / gap : 0);
        constexpr float kTurn = 2 * std::numbers::pi_v<float>;
        append(0, last, first, share);
        for (Plane const& p : all) {
            auto const angle = static_cast<float>(p.angle * kDegree);
            if (angle < kTurn) append(angle, p, p, 0);
        }
        append(kTurn, last, first, share);
    }

    std::string_view rest_, line_rest_;
    std::string const& name_;
    std::uint32_t line_ = 0;
    IesFile file_;
};

}  // namespace

IesFile parse_ies(std::string_view text, std::string const& name) { return Reader(text, name).file(); }

}  // namespace nephroid
