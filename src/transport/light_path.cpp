// Light tracing (Arvo 1986; Dutre et al. 1993; PBRT 3rd ed., 16.1; pbrt-v4's LightPathIntegrator): the walk of photons, connected to
// the camera at every vertex.
//
// A pixel is an integral over paths, whichever end they are built from (Veach 1997, eq. 8.7). Estimator, for paths from the light:
//   I_j = sum over vertices of beta f*(wo -> camera) |cos| W_j V,
// W_j being the camera's importance (model/camera.h) times pixel j's filter. What the camera sees in mirrors or through glass cannot
// be connected and is missing, and so is light at infinity that shines right into it. Nothing is estimated by density: for the rest
// it is an independent witness.
#include "light_path_image.h"
#include "light_walk.h"
#include "scene/match.h"

#include <tbb/parallel_for.h>

#include <atomic>

namespace nephroid {

namespace {

constexpr std::uint64_t kChunkPaths = 512;  // heard of a stop after so many
constexpr std::uint64_t kWaveChunks = 256;  // splats of so many chunks are kept, then added up

/// Draws paths of one pass.
class LightPathPen {
  public:
    LightPathPen(RenderJob const& job, LightPathImage const& image, std::uint64_t pass, std::uint64_t paths,
                 int max_depth)
        : job_(job), image_(image), pass_(pass), paths_(paths), max_depth_(max_depth) {
        // maxcomponentvalue is meant for what a sample says a pixel is: so does a path, when there are as many as pixels.
        Vec2i const r = job.settings().film.resolution;
        double const share = static_cast<double>(r.x) * static_cast<double>(r.y) / static_cast<double>(paths);
        most_ = job.settings().film.max_component * static_cast<float>(share);
    }

    void draw(std::uint64_t path, SplatChunk& splats, RayStats& stats) const {
        PathSampler sampler(job_.light_sequence(), stream::kLightPaths, 0, pass_ * paths_ + path);
        sampler.at(dimension::kPathWavelength);
        Wavelengths const lambda = job_.settings().color == ColorMode::Rgb
                                       ? Wavelengths::rgb()
                                       : Wavelengths::spectral(sampler.next_1d());
        PathContext c{job_, job_.world(), lambda, sampler, stats};
        auto start = emit(c, nullptr, paths_);
        if (!start) return;
        connect_source(c, *start, splats);
        Walk& walk = start->walk;
        Vertex v;
        Spectrum unasked;
        while (walk.vertex < static_cast<std::uint32_t>(max_depth_)) {
            if (!advance(c, walk, EmissionWeight::None, v, unasked) || !prepare(c, walk, v)) break;
            if (!v.is.delta) connect(c, walk, v, splats);
            // A path of max_depth bounces is at its end; what is not drawn need not be walked.
            if (walk.vertex + 1 >= static_cast<std::uint32_t>(max_depth_)) break;
            Spectrum const before = walk.beta;
            if (!scatter(c, walk, v) || !survives_with_power(c, walk, before)) break;
        }
        if (c.tainted) ++stats.rejected;  // a ray that could not be followed: something is missing
    }

  private:
    struct View {
        CameraSample camera;
        Vec2i pixel{0, 0};
        float weight = 0;  // importance times the filter's
    };

    /// The camera as p sees it, and the pixel that light from there counts for; nothing where that is not in the picture.
    std::optional<View> view(PathContext& c, Vec3 p, std::uint32_t lens_number,
                             std::uint32_t pixel_number) const {
        Vec2 lens{0.5f, 0.5f};
        if (job_.camera().has_lens()) {
            c.sampler.at(lens_number);
            lens = c.sampler.next_2d();
        }
        auto const camera = job_.camera().sample_importance(p, lens);
        Vec2i const size = job_.settings().film.resolution;
        Vec2 const reach = radius(job_.settings().filter) + Vec2{1, 1};
        if (!camera || !(camera->raster.x > -reach.x && camera->raster.y > -reach.y &&
                         camera->raster.x < static_cast<float>(size.x) + reach.x &&
                         camera->raster.y < static_cast<float>(size.y) + reach.y))
            return std::nullopt;
        c.sampler.at(pixel_number);
        Vec2 const number = c.sampler.next_2d();
        FilterPixel chosen = job_.filter().choose_pixel(camera->raster, number);
        // Panoramas have no edge: a pixel beyond it is one on the other side.
        if (chosen.pixel.x < 0 || chosen.pixel.y < 0 || chosen.pixel.x >= size.x ||
            chosen.pixel.y >= size.y) {
            auto const wrapped = [&](Vec2i outside) {
                Vec2 const within = job_.camera().wrap(
                    {static_cast<float>(outside.x) + 0.5f, static_cast<float>(outside.y) + 0.5f});
                return Vec2i{static_cast<int>(std::floor(within.x)), static_cast<int>(std::floor(within.y))};
            };
            Vec2i const within = wrapped(chosen.pixel);
            if (job_.camera().by_latitude() && (chosen.pixel.y < 0 || chosen.pixel.y >= size.y)) {
                // Over a pole the columns are others.
                float const half_turn = 0.5f * static_cast<float>(size.x);
                Vec2 const turned{camera->raster.x + half_turn, camera->raster.y};
                chosen = job_.filter().choose_pixel(turned, number);
                chosen.pixel = {wrapped({chosen.pixel.x, within.y}).x, within.y};
            } else {
                chosen.pixel = within;
            }
        }
        if (chosen.weight == 0.0f) return std::nullopt;
        View const found{*camera, chosen.pixel, camera->importance * chosen.weight};
        if (!image_.holds(found.pixel)) return std::nullopt;
        return found;
    }

    /// The share of light that gets from a surface to the camera.
    float passing(PathContext& c, SurfaceHit const& from, CameraSample const& camera) const {
        LightSample to;
        to.p = camera.from;
        to.wi = camera.wi;
        return c.world.transmittance(from, to, c.stats);
    }

    void connect(PathContext& c, Walk const& walk, Vertex const& v, SplatChunk& splats) const {
        auto const seen = view(c, v.hit.s.p, dimension::of(walk.vertex, dimension::kCameraLens),
                               dimension::of(walk.vertex, dimension::kCameraPixel));
        if (!seen) return;
        Vec3 const wi = seen->camera.wi;
        Vec3 const wi_local = v.frame.to_local(wi);
        Spectrum const f = evaluate(v.bsdf, v.wo_local, wi_local, Mode::Importance);
        if (f.is_black()) return;
        float const share = passing(c, v.hit, seen->camera);
        if (share == 0.0f) return;
        float const cosine = abs_cos_theta(wi_local) *
                             shading_normal_scale(Mode::Importance, -walk.ray.d, wi, v.hit.s.ns, v.hit.s.ng);
        Spectrum light = walk.beta * f * (cosine * share * seen->weight);
        if (c.world.encloses()) light *= transmittance(c, beyond(c, walk, v, wi), seen->camera.distance);
        add(c, light, walk.path_class.seen_after(v.is.near_specular), seen->pixel, splats);
    }

    /// The source itself, as the camera sees it: a surface, for a point or a direction has no picture.
    void connect_source(PathContext& c, LightStart const& start, SplatChunk& splats) const {
        LightRay const& source = start.ray;
        EmissionSample const& e = source.emission;
        if (e.n == Vec3(0) || source.unseen) return;
        auto const seen = view(c, e.ray.o, dimension::kSourceLens, dimension::kSourcePixel);
        if (!seen) return;
        float const cosine = dot(e.n, seen->camera.wi);
        if (!(cosine > 0.0f)) return;
        SurfaceHit from;
        from.s.p = e.ray.o;
        from.s.p_error = e.p_error;
        from.s.ng = e.n;
        float const share = passing(c, from, seen->camera);
        if (share == 0.0f) return;
        Spectrum light =
            e.radiance * (cosine * share * seen->weight /
                          (e.pdf_position * source.choice * source.side * static_cast<float>(paths_)));
        if (c.world.encloses()) light *= transmittance(c, start.walk.interiors, seen->camera.distance);
        add(c, light, LightClass::Direct, seen->pixel, splats);
    }

    void add(PathContext& c, Spectrum light, LightClass which, Vec2i pixel, SplatChunk& splats) const {
        Vec3 rgb = job_.sensor()(light, c.lambda);
        if (!is_finite(rgb)) {
            c.tainted = true;
            return;
        }
        float const largest = max_component(rgb);
        if (largest > most_) rgb *= most_ / largest;
        splats.add(
            {image_.index(pixel.x, pixel.y) | static_cast<std::uint32_t>(which) << Splat::kPixelBits, rgb});
    }

    RenderJob const& job_;
    LightPathImage const& image_;
    std::uint64_t pass_, paths_;
    int max_depth_;
    float most_;
};

}  // namespace

std::optional<LightPathImage> draw_light_paths(RenderJob const& job, std::uint64_t pass,
                                               PrepareControl const& control, RayStats& stats) {
    auto const& integrator = std::get<LightPathIntegrator>(job.settings().integrator);
    Vec2i const size = job.settings().film.resolution;
    std::uint64_t const paths = integrator.paths >= 0
                                    ? static_cast<std::uint64_t>(integrator.paths)
                                    : static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
    std::optional<LightPathImage> image(std::in_place, job.crop(), job.settings().film.aovs);
    if (paths == 0) return image;
    LightPathPen const pen(job, *image, pass, paths, integrator.max_depth);
    std::uint64_t const chunks = (paths + kChunkPaths - 1) / kChunkPaths;
    std::vector<SplatChunk> wave(std::min(chunks, kWaveChunks));
    std::vector<RayStats> wave_stats(wave.size());
    for (std::uint64_t first = 0; first < chunks; first += wave.size()) {
        std::uint64_t const count = std::min<std::uint64_t>(wave.size(), chunks - first);
        tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t k) {
            if (control.stopped()) return;
            SplatChunk& splats = wave[k];
            splats.clear();
            std::uint64_t const begin = (first + k) * kChunkPaths;
            for (std::uint64_t path = begin; path < std::min(paths, begin + kChunkPaths); ++path)
                pen.draw(path, splats, wave_stats[k]);
            splats.sort();
        });
        if (control.stopped()) return std::nullopt;
        image->add(std::span(wave).first(count));
        if (control.on_progress)
            control.on_progress(static_cast<double>(first + count) / static_cast<double>(chunks));
    }
    for (RayStats const& s : wave_stats) stats.add(s);
    return image;
}

}  // namespace nephroid
