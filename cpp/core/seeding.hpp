#pragma once

#include <ompl/util/RandomNumbers.h>

#include <cstdint>
#include <memory>
#include <mutex>

namespace planformer {

/// The seeds of one plan's parts, all different.
///
/// Two samplers with one seed draw the same states, and among equal states planners choose by
/// memory address.
class Seeds {
public:
    explicit Seeds(std::uint32_t seed) : last_(seed) {}

    /// A Weyl sequence, which visits all 2^32 numbers; OMPL takes zero for "no seed".
    std::uint32_t next() {
        last_ += 0x9e3779b9u;
        return last_ == 0 ? next() : last_;
    }

private:
    std::uint32_t last_;
};

using SeedsPtr = std::shared_ptr<Seeds>;

/// One lock for every construction in this process, recursive because constructing a planner may
/// allocate samplers that are seeded as well. (A static in the template below would be one lock
/// for each type of `make`.)
inline std::recursive_mutex seeding_mutex;

/// Runs `make` so that every OMPL object it constructs draws the same numbers for the same seed.
///
/// OMPL seeds its generators from one process-wide sequence when they are constructed. Restarting
/// the sequence under one lock round each construction makes parallel plans reproducible.
template <typename Make>
auto seeded(std::uint32_t seed, Make&& make) {
    const std::lock_guard<std::recursive_mutex> lock(seeding_mutex);
    ompl::RNG::setSeed(seed);
    return make();
}

}  // namespace planformer
