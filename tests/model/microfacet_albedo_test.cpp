// The tables of microfacet albedos against quadrature of the models, at places between their nodes.
#include "model/microfacet_albedo.h"

#include "microfacet_support.h"

using namespace nephroid;
using namespace nephroid::test;

namespace {

float const kAlphas[] = {0.001f, 0.004f, 0.013f, 0.05f, 0.12f, 0.28f, 0.55f, 0.8f, 1.0f};
float const kCosines[] = {1e-3f, 0.013f, 0.06f, 0.17f, 0.34f, 0.52f, 0.71f, 0.745f, 0.78f, 0.93f, 1.0f};

Parts lattice(Microfacets const& m, float mu, float eta) {
    return albedo_by_lattice(m, {std::sqrt(1 - mu * mu), 0, mu}, eta);
}

}  // namespace

TEST_CASE("microfacet albedo: the table of perfect mirrors against quadrature") {
    for (NamedDistribution const& facet : kDistributions) {
        double worst = 0, where_mu = 0, where_alpha = 0, worst_average = 0;
        for (float const alpha : kAlphas) {
            for (float const mu : kCosines) {
                double const e = lattice(Microfacets{alpha, alpha, facet.kind}, mu, 0).reflected;
                double const off =
                    std::abs(static_cast<double>(microfacet_albedo(facet.kind, mu, alpha)) - e);
                if (off > worst) worst = off, where_mu = mu, where_alpha = alpha;
            }
            double sum = 0;
            for (int i = 0; i < 50; ++i) {
                float const mu = std::sqrt((static_cast<float>(i) + 0.5f) / 50);
                sum += lattice(Microfacets{alpha, alpha, facet.kind}, mu, 0).reflected / 50;
            }
            worst_average =
                std::max(worst_average,
                         std::abs(static_cast<double>(microfacet_albedo_average(facet.kind, alpha)) - sum));
        }
        MESSAGE(facet.name, ": greatest error ", worst, " at mu ", where_mu, ", alpha ", where_alpha,
                "; of the average ", worst_average);
        CHECK(worst <= 0.03);
        CHECK(worst_average <= 0.002);
    }
}

TEST_CASE("microfacet albedo: the tables of dielectrics against quadrature") {
    for (NamedDistribution const& facet : kDistributions) {
        double worst[2] = {0, 0}, sum = 0;
        int n = 0;
        std::string where;
        for (float const eta : {1.5f, 1 / 1.5f, 1.33f, 1 / 1.33f, 2.4f, 1 / 2.4f, 1.07f, 0.95f})
            for (float const alpha : kAlphas)
                for (float const mu : kCosines) {
                    Parts const p = lattice(Microfacets{alpha, alpha, facet.kind}, mu, eta);
                    double const off[2] = {std::abs(static_cast<double>(dielectric_reflection_albedo(
                                                        facet.kind, mu, alpha, eta)) -
                                                    p.reflected),
                                           std::abs(static_cast<double>(dielectric_transmission_albedo(
                                                        facet.kind, mu, alpha, eta)) -
                                                    p.transmitted)};
                    for (int k = 0; k < 2; ++k) {
                        sum += off[k], ++n;
                        if (off[k] > std::max(worst[0], worst[1]))
                            where = "mu " + std::to_string(mu) + ", alpha " + std::to_string(alpha) +
                                    ", eta " + std::to_string(eta);
                        worst[k] = std::max(worst[k], off[k]);
                    }
                }
        MESSAGE(facet.name, ": greatest errors: reflected ", worst[0], ", transmitted ", worst[1], " (",
                where, "); mean ", sum / n);
        CHECK(worst[0] <= 0.07);
        CHECK(worst[1] <= 0.05);
        CHECK(sum / n <= 0.0045);
    }
}
