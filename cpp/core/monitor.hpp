#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/PlannerTerminationCondition.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <limits>

#include "core/progress.hpp"
#include "core/state_count.hpp"

namespace planformer {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point started) {
    return std::chrono::duration<double>(Clock::now() - started).count();
}

/// A length with slack for rounding: a path's length is a sum that planners take in another order.
inline double with_slack(double length) { return length * (1.0 + 1e-9); }

/// When a search ends. Infinite and maximal values mean "no limit".
struct Limits {
    double seconds = std::numeric_limits<double>::infinity();
    double target_length = 0.0;  ///< stop at the first path this short [m]; 0: never
    std::size_t vertices = std::numeric_limits<std::size_t>::max();

    /// The longest path that meets the target.
    double longest_on_target() const { return with_slack(target_length); }
};

/// Why a search ended.
enum class Outcome {
    kFinished,  ///< the planner ended by itself
    kTarget,    ///< a path at most as long as the target was found
    kTimeLimit,
    kVertexLimit,
    kCancelled,
};

/// Lets another thread end a search.
class Cancellation {
public:
    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
    bool is_cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

private:
    std::atomic<bool> cancelled_{false};
};

/// Ends a search at its limits and remembers which of them it was; lets snapshots be taken.
class Monitor {
public:
    /// The time limit counts from `started`; `interrupted` is asked about every 20 ms and may be
    /// empty, and so may the recorder. Planner, count and recorder have to outlive the monitor.
    Monitor(const Limits& limits, Clock::time_point started, const ompl::base::Planner& planner,
            const StateCount& states, const Cancellation* cancellation,
            std::function<bool()> interrupted, Recorder* recorder);

    ompl::base::PlannerTerminationCondition condition();

    /// Call after the search; `best_length` is infinite without a path.
    Outcome outcome(double best_length) const;

private:
    bool should_stop();
    bool is_interrupted();
    bool has_too_many_vertices();

    Limits limits_;
    const ompl::base::Planner& planner_;
    const StateCount& states_;
    const Cancellation* cancellation_;
    std::function<bool()> interrupted_;
    Recorder* recorder_;
    Clock::time_point started_;
    double next_interrupt_check_ = 0.0;
    std::size_t next_vertex_check_;
    Outcome reason_ = Outcome::kFinished;
};

}  // namespace planformer
