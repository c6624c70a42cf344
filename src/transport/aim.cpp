#include "aim.h"

#include "caster_balls.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

constexpr std::uint64_t kMostWays = 1u << 19;
constexpr std::uint64_t kMostBalls = 32;
constexpr std::uint64_t kMostSide = 8;
/// Rays that are tried in all before any is sent, about.
constexpr std::uint64_t kProbes = 1u << 18;
/// No way that may carry light is left out because the probes did not see it: of what would be sent that way if the light shone
/// evenly, it gets this share.
constexpr double kFloor = 0.02;

/// Points of the unit square, twice: the additive recurrence with the powers of the root of x^5 = x + 1 (Roberts 2018).
struct Probe {
    Vec2 position, direction;

    explicit Probe(std::uint64_t i) {
        double x[4];
        for (int d = 0; d < 4; ++d) {
            constexpr double kStep[4] = {0.85667488385450287, 0.73389185662610951, 0.62870672080701250,
                                         0.53859725722361111};
            double const y = 0.5 + kStep[d] * static_cast<double>(i + 1);
            x[d] = std::min(y - std::floor(y), static_cast<double>(kOneMinusEpsilon));
        }
        position = {static_cast<float>(x[0]), static_cast<float>(x[1])};
        direction = {static_cast<float>(x[2]), static_cast<float>(x[3])};
    }
};

double power_of(std::optional<LightRay> const& ray) {
    if (!ray) return 0;
    auto const watts = static_cast<double>(ray->power().max());
    return std::isfinite(watts) ? watts : 0;
}

/// The share of all directions that a ball takes up.
double share_of_directions(BoundingSphere const& ball, Vec3 from) {
    auto const sin2 = static_cast<double>(sqr(ball.radius) / distance_squared(from, ball.centre));
    return sin2 < 1 ? sin2 / (2 * (1 + std::sqrt(1 - sin2))) : 1;
}

bool meets(BoundingSphere const& ball, Ray const& ray) {
    Vec3 const to = ball.centre - ray.o;
    return length_squared(cross(to, ray.d)) <= sqr(ball.radius) &&
           (dot(to, ray.d) > 0.0f || length_squared(to) <= sqr(ball.radius));
}

/// u within one of side x side cells.
Vec2 within(std::uint32_t cell, std::uint32_t side, Vec2 u) {
    auto const place = [&](std::uint32_t i, float x) {
        return min((static_cast<float>(i) + x) / static_cast<float>(side), kOneMinusEpsilon);
    };
    return {place(cell % side, u.x), place(cell / side, u.y)};
}

}  // namespace

/// How much power the ways of one light carry.
class Aim::Builder {
  public:
    Builder(Aim const& aim, World const& world) : aim_(aim), world_(world) {
        std::uint64_t const ways = std::max<std::uint64_t>(1, aim.first_.back());
        probes_ = std::clamp<std::uint64_t>(kProbes / ways, 1, 16);
    }

    void weigh(std::uint32_t light, std::span<float> weights) const {
        double const power = static_cast<double>(world_.power_of(light));
        if (!(power > 0)) return;
        if (world_.has_surface(light))
            weigh_surface(light, power, weights);
        else
            weigh_other(light, power, weights);
        for (float& w : weights)
            if (!std::isfinite(w)) w = 0;
    }

  private:
    [[nodiscard]] float share(double power) const {
        return static_cast<float>(power / static_cast<double>(world_.total_power()));
    }

    void weigh_surface(std::uint32_t light, double power, std::span<float> weights) const {
        std::uint32_t const cells = aim_.side_ * aim_.side_;
        for (std::uint32_t b = 0; b < aim_.balls_.size(); ++b) {
            BoundingSphere const& ball = aim_.balls_[b];
            if (!world_.may_reach(light, ball)) continue;
            for (std::uint32_t cell = 0; cell < cells; ++cell) {
                double sum = 0;
                for (std::uint64_t i = 0; i < probes_; ++i) {
                    Probe const u(i);
                    sum += power_of(world_.emit(light, &ball, within(cell, aim_.side_, u.position),
                                                u.direction, Wavelengths::rgb()));
                }
                Probe const somewhere(0);
                auto const from = world_.emit(light, nullptr, within(cell, aim_.side_, {0.5f, 0.5f}),
                                              somewhere.direction, Wavelengths::rgb());
                double const even = from ? share_of_directions(ball, from->emission.ray.o) : 1;
                weights[cell * aim_.per_cell() + b] =
                    share((sum / static_cast<double>(probes_) + kFloor * power * even) / cells);
            }
        }
    }

    void weigh_other(std::uint32_t light, double power, std::span<float> weights) const {
        std::size_t const count = aim_.balls_.size();
        std::uint64_t const probes = probes_ > 1 ? 4 * probes_ : 1;
        auto const n = static_cast<double>(probes);
        // As it shines by itself, who gets how much?
        std::vector<double> gets(count);
        double all = 0;
        Vec3 from{0, 0, 0};
        bool shone = false;
        for (std::uint64_t i = 0; i < probes; ++i) {
            Probe const u(i);
            auto const ray = world_.emit(light, nullptr, u.position, u.direction, Wavelengths::rgb());
            double const watts = power_of(ray);
            all += watts;
            if (ray) from = ray->emission.ray.o, shone = true;
            for (std::size_t b = 0; b < count; ++b)
                if (ray && meets(aim_.balls_[b], ray->emission.ray)) gets[b] += watts;
        }
        auto const scene = static_cast<double>(bounding_sphere(world_.bounds()).radius);
        for (std::size_t b = 0; b < count; ++b) {
            BoundingSphere const& ball = aim_.balls_[b];
            if (!world_.may_reach(light, ball)) continue;
            double sum = 0;
            double squares = 0;
            for (std::uint64_t i = 0; i < probes; ++i) {
                Probe const u(i);
                double const watts =
                    power_of(world_.emit(light, &ball, u.position, u.direction, Wavelengths::rgb()));
                sum += watts;
                squares += watts * watts;
            }
            // Of rays that are sent, how many were worth it: those of equal power, or those that meet the ball.
            double const aimed = squares > 0 ? sum * sum / (n * squares) : 0;
            double const plain = all > 0 ? gets[b] / all : 0;
            // Nobody knows where a light is of which no probe came.
            bool const surrounded =
                !shone || (!world_.is_boundless(light) && distance(from, ball.centre) <= ball.radius);
            if (plain > aimed || surrounded) {
                weights[count] = share(power);
                continue;
            }
            double const even = world_.is_boundless(light)
                                    ? std::min(1.0, sqr(static_cast<double>(ball.radius) / scene))
                                    : share_of_directions(ball, from);
            weights[b] = share(sum / n + kFloor * power * even);
        }
    }

    Aim const& aim_;
    World const& world_;
    std::uint64_t probes_ = 1;
};

Aim::Aim(World const& world) {
    auto const lights = static_cast<std::uint32_t>(world.counts().lights);
    if (lights == 0 || !(world.total_power() > 0.0f)) return;
    balls_ = caster_balls(world.casters(), std::clamp<std::uint64_t>(kMostWays / lights, 1, kMostBalls));
    if (balls_.empty()) return;
    std::uint64_t const pairs = lights * static_cast<std::uint64_t>(per_cell());
    auto const side = static_cast<std::uint64_t>(std::sqrt(65536.0 / static_cast<double>(pairs)));
    side_ = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(side, 1, kMostSide));
    first_.reserve(lights + 1);
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < lights; ++i) {
        first_.push_back(next);
        next += cells(world, i) * per_cell();
    }
    first_.push_back(next);
    std::vector<float> weights(next);
    Builder const builder(*this, world);
    tbb::parallel_for(std::uint32_t{0}, lights, [&](std::uint32_t i) {
        builder.weigh(i, std::span(weights).subspan(first_[i], first_[i + 1] - first_[i]));
    });
    ways_ = AliasTable(weights);
}

Aim::Way Aim::choose(double u) const {
    std::uint32_t const way = ways_.sample(u).index;
    auto const after = std::upper_bound(first_.begin(), first_.end(), way);
    auto const light = static_cast<std::uint32_t>(after - first_.begin()) - 1;
    std::uint32_t const own = way - first_[light];
    return {light, own / per_cell(), own % per_cell()};
}

std::optional<LightRay> Aim::sample(World const& world, Way way, Vec2 u_position, Vec2 u_direction,
                                    Wavelengths const& lambda) const {
    if (world.has_surface(way.light)) u_position = within(way.cell, side_, u_position);
    auto ray = world.emit(way.light, way.ball < balls_.size() ? &balls_[way.ball] : nullptr, u_position,
                          u_direction, lambda);
    if (!ray) return ray;
    float& aimed = world.is_boundless(way.light) ? ray->emission.pdf_position : ray->emission.pdf_direction;
    aimed = max(density(world, *ray, way.cell),
                // by rounding, a ray may just miss the ball that it was sent to
                ways_.pmf(first_[way.light] + way.cell * per_cell() + way.ball) *
                    static_cast<float>(cells(world, way.light)) * aimed);
    return ray;
}

float Aim::density(World const& world, LightRay const& ray, std::uint32_t cell) const {
    std::uint32_t const first = first_[ray.light] + cell * per_cell();
    float sum = 0;
    for (std::uint32_t b = 0; b < balls_.size(); ++b)
        if (float const p = ways_.pmf(first + b); p > 0.0f) sum += p * world.aimed_density(ray, &balls_[b]);
    if (float const p = ways_.pmf(first + static_cast<std::uint32_t>(balls_.size())); p > 0.0f)
        sum += p * world.aimed_density(ray, nullptr);
    return sum * static_cast<float>(cells(world, ray.light));
}

}  // namespace nephroid
