#include "core/monitor.hpp"

#include <ompl/base/PlannerData.h>

#include "core/planners.hpp"

namespace planformer {

namespace ob = ompl::base;

namespace {

constexpr double kInterruptPeriod = 0.02;  // [s]

/// Path lengths are sums in another order than the planner's, so the target needs a little slack.
constexpr double kLengthTolerance = 1e-9;

}  // namespace

std::size_t count_vertices(const ob::Planner& planner, const StateCount& states) {
    // Asking these planners for their graph leaks it (OMPL 1.5 keeps it in a static variable), and
    // each of their samples is checked exactly once.
    if (samples_in_batches(planner)) return states.accepted;
    ob::PlannerData data(planner.getSpaceInformation());
    planner.getPlannerData(data);
    return data.numVertices();
}

Monitor::Monitor(const Limits& limits, Clock::time_point started, const ob::Planner& planner,
                 StateCountPtr states, const Cancellation* cancellation, std::function<bool()> interrupted)
    : limits_(limits),
      planner_(planner),
      states_(std::move(states)),
      cancellation_(cancellation),
      interrupted_(std::move(interrupted)),
      started_(started),
      next_vertex_check_(limits.vertices),
      thread_(std::this_thread::get_id()) {}

ob::PlannerTerminationCondition Monitor::condition() {
    return ob::PlannerTerminationCondition([this] { return should_stop(); });
}

bool Monitor::should_stop() {
    if (reason_ != Outcome::kFinished) return true;
    if (seconds_since(started_) >= limits_.seconds) {
        reason_ = Outcome::kTimeLimit;
    } else if (is_interrupted()) {
        reason_ = Outcome::kCancelled;
    } else if (has_too_many_vertices()) {
        reason_ = Outcome::kVertexLimit;
    }
    return reason_ != Outcome::kFinished;
}

bool Monitor::is_interrupted() {
    if (cancellation_ != nullptr && cancellation_->is_cancelled()) return true;
    // PRM* also evaluates the condition in a thread of its own, which must not ask.
    if (!interrupted_ || std::this_thread::get_id() != thread_) return false;
    if (seconds_since(started_) < next_interrupt_check_) return false;
    next_interrupt_check_ = seconds_since(started_) + kInterruptPeriod;
    return interrupted_();
}

bool Monitor::has_too_many_vertices() {
    if (states_->alive < next_vertex_check_ || std::this_thread::get_id() != thread_) return false;
    const std::size_t vertices = count_vertices(planner_, *states_);
    if (vertices >= limits_.vertices) return true;
    next_vertex_check_ = states_->alive + (limits_.vertices - vertices);
    return false;
}

Outcome Monitor::outcome(double best_length) const {
    if (best_length <= limits_.target_length * (1.0 + kLengthTolerance)) return Outcome::kTarget;
    return reason_;
}

}  // namespace planformer
