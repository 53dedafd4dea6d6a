#pragma once

#include <ompl/base/State.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>

namespace planformer {

/// What a search has made so far.
struct StateCount {
    /// States that the state space has handed out and not got back. They bound the vertices of
    /// every planner from above at no cost.
    std::atomic<std::size_t> alive{0};
    /// States found free, which are the vertices of planners that sample in batches.
    std::atomic<std::size_t> accepted{0};
};

/// Shared, because OMPL 1.5 keeps some states of BIT* and AIT* until the process ends.
using StateCountPtr = std::shared_ptr<StateCount>;

/// A state space that counts its states.
template <typename Space>
class Counted : public Space {
public:
    template <typename... Args>
    explicit Counted(StateCountPtr count, Args&&... args)
        : Space(std::forward<Args>(args)...), count_(std::move(count)) {}

    ompl::base::State* allocState() const override {
        count_->alive.fetch_add(1, std::memory_order_relaxed);
        return Space::allocState();
    }

    void freeState(ompl::base::State* state) const override {
        count_->alive.fetch_sub(1, std::memory_order_relaxed);
        Space::freeState(state);
    }

private:
    StateCountPtr count_;
};

}  // namespace planformer
