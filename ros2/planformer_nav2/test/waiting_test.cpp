#include "planformer_nav2/waiting.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>
#include <vector>

namespace planformer_nav2 {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kLong = std::chrono::hours(1);

bool never() { return false; }

TEST(WaitForAnswer, EndsWithTheAnswer) {
    int calls = 0;
    const auto third_time = [&](nanoseconds) { return ++calls == 3; };
    EXPECT_EQ(wait_for_answer(kLong, third_time, never), Wait::kAnswered);
    EXPECT_EQ(calls, 3);
}

TEST(WaitForAnswer, EndsWhenTheTimeIsOver) {
    const auto sleep = [](nanoseconds time) {
        std::this_thread::sleep_for(time);
        return false;
    };
    EXPECT_EQ(wait_for_answer(milliseconds(25), sleep, never), Wait::kTimedOut);
}

TEST(WaitForAnswer, DoesNotAskWithoutTime) {
    const auto unexpected = [](nanoseconds) -> bool { throw std::logic_error("asked"); };
    EXPECT_EQ(wait_for_answer(nanoseconds(0), unexpected, never), Wait::kTimedOut);
    EXPECT_EQ(wait_for_answer(nanoseconds(-1), unexpected, never), Wait::kTimedOut);
}

TEST(WaitForAnswer, EndsWhenCancelled) {
    int calls = 0;
    const auto no_answer = [&](nanoseconds) {
        ++calls;
        return false;
    };
    const auto after_two = [&] { return calls == 2; };
    EXPECT_EQ(wait_for_answer(kLong, no_answer, after_two), Wait::kCancelled);
    EXPECT_EQ(calls, 2);
}

TEST(WaitForAnswer, IsCancelledBeforeItAsks) {
    const auto unexpected = [](nanoseconds) -> bool { throw std::logic_error("asked"); };
    EXPECT_EQ(wait_for_answer(kLong, unexpected, [] { return true; }), Wait::kCancelled);
}

TEST(WaitForAnswer, GivesShortTurnsWithinTheTime) {
    std::vector<nanoseconds> turns;
    const auto sleep = [&](nanoseconds time) {
        turns.push_back(time);
        std::this_thread::sleep_for(time);
        return false;
    };
    EXPECT_EQ(wait_for_answer(milliseconds(15), sleep, never), Wait::kTimedOut);
    ASSERT_FALSE(turns.empty());
    for (const nanoseconds turn : turns) {
        EXPECT_GT(turn.count(), 0);
        EXPECT_LE(turn, kCancelPeriod);
    }
}

}  // namespace
}  // namespace planformer_nav2
