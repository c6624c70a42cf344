// How the benchmarks measure.
#pragma once

#include <algorithm>
#include <vector>

#include <time.h>

namespace nephroid::bench {

/// Processor time of this thread, which is all that works then: what else the machine does costs it no time, only caches.
inline double thread_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
template <class F>
double seconds_of(F&& f) {
    double const t0 = thread_seconds();
    f();
    return thread_seconds() - t0;
}

inline double median(std::vector<double> v) {
    std::sort(v.begin(), v.end());
    std::size_t const n = v.size();
    return n % 2 ? v[n / 2] : 0.5 * (v[n / 2 - 1] + v[n / 2]);
}

}  // namespace nephroid::bench
