// The world's records, in one place that does not move.
#pragma once

#include "records.h"

#include <vector>

namespace nephroid {

struct WorldParts {
    std::vector<ObjectRecord> records;
    std::vector<InstanceRecord> instances;
    std::vector<std::uint32_t> first_record, record_count;  // by GroupId
    bool partly = false;                                    // does any surface let a part of the light pass?

    /// How many records the group has whose first one is `first`.
    [[nodiscard]] std::uint32_t count_from(std::uint32_t first) const {
        for (std::size_t g = 1; g < first_record.size(); ++g)
            if (first_record[g] == first && record_count[g] > 0) return record_count[g];
        return 0;
    }
};

}  // namespace nephroid
