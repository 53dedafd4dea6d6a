#pragma once

#include <ompl/geometric/planners/rrt/SORRTstar.h>

namespace planformer {

/// OMPL's SORRT* without its leak: the ordered samples that were not used yet are never freed.
class TidySORRTstar : public ompl::geometric::SORRTstar {
public:
    using SORRTstar::SORRTstar;

    void clear() override;
};

}  // namespace planformer
