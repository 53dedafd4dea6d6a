#pragma once

#include <ompl/base/State.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>

namespace planformer {

/// The number of states that a state space has handed out and not got back.
///
/// It bounds the vertices of every planner from above at no cost, so that the exact count is taken
/// only when it can matter.
using StateCount = std::atomic<std::size_t>;

/// Shared, because OMPL's EIT* keeps some states until the process ends.
using StateCountPtr = std::shared_ptr<StateCount>;

/// A state space that counts its states.
template <typename Space>
class Counted : public Space {
public:
    template <typename... Args>
    explicit Counted(StateCountPtr count, Args&&... args)
        : Space(std::forward<Args>(args)...), count_(std::move(count)) {}

    ompl::base::State* allocState() const override {
        count_->fetch_add(1, std::memory_order_relaxed);
        return Space::allocState();
    }

    void freeState(ompl::base::State* state) const override {
        count_->fetch_sub(1, std::memory_order_relaxed);
        Space::freeState(state);
    }

private:
    StateCountPtr count_;
};

}  // namespace planformer
