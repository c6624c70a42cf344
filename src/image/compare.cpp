#include "image/compare.h"

#include "math/error.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

void require_same_shape(Image const& a, Image const& b) {
    auto size = [](Image const& i) {
        return std::to_string(i.width()) + " x " + std::to_string(i.height()) + " with " +
               std::to_string(i.channels()) + " channels";
    };
    if (a.empty() || a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels())
        throw Error(ErrorKind::Input, "compare: the images differ in shape (" + size(a) + ", " + size(b) +
                                          "); compare images of one shape");
}

template <class F>
double mean_over_pixels(Image const& a, Image const& b, F&& term) {
    require_same_shape(a, b);
    double sum = 0;
    std::size_t count = 0;
    int const alpha = a.channel("A").value_or(-1);
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            for (int c = 0; c < a.channels(); ++c) {
                if (c == alpha) continue;
                sum += term(double{a.get(x, y, c)}, double{b.get(x, y, c)});
                ++count;
            }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace

double rmse(Image const& a, Image const& reference) {
    return std::sqrt(mean_over_pixels(a, reference, [](double p, double q) { return sqr(p - q); }));
}

double rel_mse(Image const& a, Image const& reference) {
    return mean_over_pixels(a, reference, [](double p, double q) { return sqr(p - q) / (sqr(q) + 0.01); });
}

std::vector<double> channel_means(Image const& image) {
    std::vector<double> means(static_cast<std::size_t>(image.channels()), 0.0);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < image.channels(); ++c)
                means[static_cast<std::size_t>(c)] += image.get(x, y, c);
    for (double& m : means) m /= static_cast<double>(image.width()) * static_cast<double>(image.height());
    return means;
}

Image binned(Image const& image, int n) {
    if (n < 1 || image.empty())
        throw Error(ErrorKind::Input, "compare: bins need an image and at least one pixel a side");
    Image out(PixelFormat::Float, (image.width() - 1) / n + 1, (image.height() - 1) / n + 1,
              image.channel_names());
    for (int by = 0; by < out.height(); ++by)
        for (int bx = 0; bx < out.width(); ++bx)
            for (int c = 0; c < image.channels(); ++c) {
                double sum = 0;
                int const x1 = std::min(image.width(), (bx + 1) * n),
                          y1 = std::min(image.height(), (by + 1) * n);
                for (int y = by * n; y < y1; ++y)
                    for (int x = bx * n; x < x1; ++x) sum += image.get(x, y, c);
                out.set(bx, by, c, static_cast<float>(sum / (double(x1 - bx * n) * double(y1 - by * n))));
            }
    return out;
}

}  // namespace nephroid
