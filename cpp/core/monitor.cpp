#include "core/monitor.hpp"

#include <cmath>

#include "core/graph.hpp"

namespace planformer {

namespace ob = ompl::base;

namespace {

constexpr double kInterruptPeriod = 0.02;  // [s]

}  // namespace

Monitor::Monitor(const Limits& limits, Clock::time_point started, const ob::Planner& planner,
                 const StateCount& states, const Cancellation* cancellation,
                 std::function<bool()> interrupted, Recorder* recorder)
    : limits_(limits),
      planner_(planner),
      states_(states),
      cancellation_(cancellation),
      interrupted_(std::move(interrupted)),
      recorder_(recorder),
      started_(started),
      next_vertex_check_(limits.vertices) {}

ob::PlannerTerminationCondition Monitor::condition() {
    return ob::PlannerTerminationCondition([this] { return should_stop(); });
}

bool Monitor::should_stop() {
    if (reason_ != Outcome::kFinished) return true;
    const double seconds = seconds_since(started_);
    if (seconds >= limits_.seconds) {
        reason_ = Outcome::kTimeLimit;
    } else if (is_interrupted()) {
        reason_ = Outcome::kCancelled;
    } else if (has_too_many_vertices()) {
        reason_ = Outcome::kVertexLimit;
    } else if (recorder_ != nullptr && recorder_->is_due(seconds)) {
        recorder_->take(seconds);
    }
    return reason_ != Outcome::kFinished;
}

bool Monitor::is_interrupted() {
    if (cancellation_ != nullptr && cancellation_->is_cancelled()) return true;
    if (!interrupted_ || seconds_since(started_) < next_interrupt_check_) return false;
    next_interrupt_check_ = seconds_since(started_) + kInterruptPeriod;
    return interrupted_();
}

bool Monitor::has_too_many_vertices() {
    if (states_ < next_vertex_check_) return false;
    const std::size_t vertices = count_vertices(planner_);
    if (vertices >= limits_.vertices) return true;
    next_vertex_check_ = states_ + (limits_.vertices - vertices);
    return false;
}

Outcome Monitor::outcome(double best_length) const {
    const bool has_path = std::isfinite(best_length);
    if (has_path && best_length <= limits_.longest_on_target()) return Outcome::kTarget;
    return reason_;
}

}  // namespace planformer
