// How one light is chosen from a table.
#include "light_table.h"

#include <algorithm>

namespace nephroid {

LightTable::Choice LightTable::choose_among(Receiver const& to, LightChoice how, double u) const {
    if (by_power.empty()) return {};  // all of them are dark
    switch (how) {
        case LightChoice::Power: {
            auto const s = by_power.sample(u);
            return {s.index, s.pmf};
        }
        case LightChoice::Uniform: {
            auto const n = static_cast<double>(entries.size());
            auto const i = std::min(static_cast<std::size_t>(u * n), entries.size() - 1);
            return {static_cast<std::uint32_t>(i), static_cast<float>(1 / n)};
        }
        case LightChoice::Bvh: {
            auto const share = static_cast<double>(boundless_share());
            if (u < share) {
                auto const n = static_cast<double>(boundless.size());
                auto const i = std::min(static_cast<std::size_t>(u / share * n), boundless.size() - 1);
                return {boundless[i], static_cast<float>(share / n)};
            }
            if (auto const c = tree.sample(to, std::min((u - share) / (1 - share), 1 - 0x1p-53)))
                return {c->light, static_cast<float>(1 - share) * c->pmf};
        }
    }
    return {};
}

float LightTable::pmf(Receiver const& to, LightChoice how, std::uint32_t entry) const {
    if (by_power.empty()) return 0.0f;
    if (entries.size() == 1) return 1.0f;
    switch (how) {
        case LightChoice::Power:
            return by_power.pmf(entry);
        case LightChoice::Uniform:
            return static_cast<float>(1 / static_cast<double>(entries.size()));
        case LightChoice::Bvh: {
            float const share = boundless_share();
            if (entries[entry].boundless) return share / static_cast<float>(boundless.size());
            return (1.0f - share) * tree.pmf(to, entry);
        }
    }
    return 0.0f;
}

std::size_t LightTable::bytes() const {
    std::size_t n = emitters.size() * sizeof(Emitter) + data.size() * sizeof(LightData) +
                    entries.size() * sizeof(LightEntry) +
                    (entry_of_light.size() + entry_of_part.size()) * sizeof(std::uint32_t) +
                    boxes.size() * sizeof(BoxLight) + places.size() * sizeof(LightPlace) +
                    pictures.size() * sizeof(LightPicture) + by_power.bytes() + tree.bytes();
    for (LightData const& d : data)
        if (d.table) n += d.table->bytes();
    for (LightPicture const& p : pictures) n += p.distribution.bytes();
    return n;
}

}  // namespace nephroid
