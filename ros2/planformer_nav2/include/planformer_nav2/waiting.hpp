#pragma once

#include <algorithm>
#include <chrono>

namespace planformer_nav2 {

/// How waiting for an answer ended.
enum class Wait { kAnswered, kTimedOut, kCancelled };

/// Longest time between two looks at the cancel checker.
constexpr std::chrono::nanoseconds kCancelPeriod = std::chrono::milliseconds(10);

/// Waits until there is an answer, it takes too long, or nobody wants it any more.
///
/// `answered_within` blocks for at most the time that it is given and returns whether the answer
/// is there; `cancelled` is asked before each of its calls.
template <typename AnsweredWithin, typename Cancelled>
Wait wait_for_answer(std::chrono::nanoseconds timeout, AnsweredWithin&& answered_within,
                     Cancelled&& cancelled) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point deadline = Clock::now() + timeout;
    for (std::chrono::nanoseconds left = timeout; left.count() > 0;
         left = deadline - Clock::now()) {
        if (cancelled()) return Wait::kCancelled;
        if (answered_within(std::min(left, kCancelPeriod))) return Wait::kAnswered;
    }
    return Wait::kTimedOut;
}

}  // namespace planformer_nav2
