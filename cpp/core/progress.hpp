#pragma once

#include <ompl/base/Planner.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "core/curve.hpp"
#include "core/graph.hpp"
#include "core/incumbent.hpp"
#include "core/state_count.hpp"

namespace planformer {

/// What a search has found so far.
struct Snapshot {
    double seconds = 0.0;                                     ///< since the search began
    double length = std::numeric_limits<double>::infinity();  ///< of the best path [m]
    std::vector<Pose> path;  ///< the best path as `Answer::path` has it; empty without one
    std::size_t states = 0;  ///< that the planner holds, a few more than its tree's vertices
    Tree tree;               ///< where it was asked for
};

/// The last snapshot of a search: the planner's thread writes it, others read it.
class Progress {
public:
    /// A snapshot each `interval` seconds, or less often where that would take more than a tenth of
    /// the search's time.
    Progress(double interval, bool keep_tree) : interval_(interval), keep_tree_(keep_tree) {}

    double interval() const { return interval_; }
    bool keep_tree() const { return keep_tree_; }

    /// The last snapshot; null before the first.
    std::shared_ptr<const Snapshot> latest() const {
        const std::lock_guard<std::mutex> lock(mutex_);
        return latest_;
    }

    void publish(std::shared_ptr<const Snapshot> snapshot) {
        const std::lock_guard<std::mutex> lock(mutex_);
        latest_ = std::move(snapshot);
    }

private:
    double interval_;
    bool keep_tree_;
    mutable std::mutex mutex_;
    std::shared_ptr<const Snapshot> latest_;
};

/// Takes the snapshots of one search, in the planner's thread.
///
/// Planners tell of better paths through OMPL's callback for intermediate solutions, which the
/// incumbent hears, or by adding them to the problem while they search: these stay here, or what is
/// sampled would depend on when snapshots are taken. SST and planners that end with their first
/// path do neither.
class Recorder {
public:
    /// `step`: spacing of the poses between a car's states [m]. Planner, count and incumbent have
    /// to outlive the recorder.
    Recorder(Progress* progress, ompl::base::Planner* planner, const StateCount& states,
             const Incumbent& incumbent, double step);

    /// Whether a snapshot is due after so many seconds of the search.
    bool is_due(double seconds) const { return seconds >= next_; }

    /// Takes one; between two steps of the planner.
    void take(double seconds);

private:
    const Incumbent& best();

    Progress* progress_;
    ompl::base::Planner* planner_;
    const StateCount& states_;
    const Incumbent& incumbent_;
    Incumbent added_;  ///< to the problem
    double step_;
    double next_ = 0.0;
};

}  // namespace planformer
