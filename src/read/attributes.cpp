// The chain of what `Attribute` has set. Blocks share its links, so that neither a block nor one more Attribute copies the
// lists of those around it.
#include "params.h"

#include <algorithm>

namespace nephroid {

SharedParams with_attributes(SharedParams const& before, ParamList added) {
    // Short links are merged with what is added: a parameter that is set again and again then takes no more room.
    constexpr std::size_t kMerged = 32;
    auto link = std::make_shared<AttributeParams>();
    auto const add = [&link](std::shared_ptr<Param const> const& p) {
        bool const hidden = std::any_of(link->params.begin(), link->params.end(), [&](auto const& newer) {
            return newer->name == p->name && newer->type == p->type;
        });
        if (!hidden) link->params.push_back(p);
    };
    for (auto p = added.rbegin(); p != added.rend(); ++p) add(std::make_shared<Param const>(std::move(*p)));
    link->older = before;
    while (link->older && link->older->params.size() + link->params.size() <= kMerged) {
        auto const merged = link->older;
        for (auto const& p : merged->params) add(p);
        link->older = merged->older;
    }
    link->count = link->params.size() + (link->older ? link->older->count : 0);
    return link;
}

}  // namespace nephroid
