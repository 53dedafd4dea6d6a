#include "core/sorrt_star.hpp"

#include <ompl/base/samplers/informed/OrderedInfSampler.h>

#include "core/exposed.hpp"

namespace planformer {

namespace ob = ompl::base;

struct ClearBatchTag {
    friend constexpr auto exposed(ClearBatchTag);
};
template struct Expose<ClearBatchTag, &ob::OrderedInfSampler::clearBatch>;

void TidySORRTstar::clear() {
    if (auto* sampler = dynamic_cast<ob::OrderedInfSampler*>(infSampler_.get())) {
        (sampler->*exposed(ClearBatchTag{}))();
    }
    SORRTstar::clear();
}

}  // namespace planformer
