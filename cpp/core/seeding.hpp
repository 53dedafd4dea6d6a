#pragma once

#include <ompl/util/RandomNumbers.h>

#include <cstdint>
#include <mutex>

namespace planformer {

/// Runs `make` so that every OMPL object it constructs draws the same numbers for the same seed.
///
/// OMPL seeds its generators from one process-wide sequence when they are constructed. Restarting
/// the sequence under one lock round each construction makes parallel plans reproducible.
template <typename Make>
auto seeded(std::uint32_t seed, Make&& make) {
    // Recursive: constructing a planner may allocate samplers that are seeded here as well.
    static std::recursive_mutex mutex;
    const std::lock_guard<std::recursive_mutex> lock(mutex);
    ompl::RNG::setSeed(seed == 0 ? 1 : seed);  // OMPL takes zero for "no seed"
    return make();
}

}  // namespace planformer
