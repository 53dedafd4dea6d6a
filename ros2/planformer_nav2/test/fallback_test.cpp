#include "planformer_nav2/fallback.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace planformer_nav2 {
namespace {

struct NoPath : std::runtime_error {
    using std::runtime_error::runtime_error;
};
struct Cancelled : std::runtime_error {
    using std::runtime_error::runtime_error;
};
struct CancelledByUser : Cancelled {
    using Cancelled::Cancelled;
};

/// Runs a guided attempt that is recoverable unless it throws Cancelled; unguided returns 2.
struct Attempt {
    template <typename Guided>
    int run(bool fallback, Guided&& guided) {
        return with_fallback(
            fallback, [&] { return recoverable<Cancelled>(guided); },
            [this] {
                ++unguided_calls;
                return 2;
            },
            [this](const char* reason) { reasons.emplace_back(reason); });
    }

    int unguided_calls = 0;
    std::vector<std::string> reasons;
};

int fail() { throw NoPath("no path"); }

TEST(Fallback, ReturnsTheGuidedResult) {
    Attempt attempt;
    EXPECT_EQ(attempt.run(true, [] { return 1; }), 1);
    EXPECT_EQ(attempt.unguided_calls, 0);
    EXPECT_TRUE(attempt.reasons.empty());
}

TEST(Fallback, ReturnsTheUnguidedResultAfterAFailure) {
    Attempt attempt;
    EXPECT_EQ(attempt.run(true, fail), 2);
    EXPECT_EQ(attempt.unguided_calls, 1);
    EXPECT_EQ(attempt.reasons, std::vector<std::string>{"no path"});
}

TEST(Fallback, LetsFinalErrorsPass) {
    Attempt attempt;
    EXPECT_THROW(attempt.run(true, []() -> int { throw Cancelled("stop"); }), Cancelled);
    EXPECT_THROW(attempt.run(true, []() -> int { throw CancelledByUser("stop"); }),
                 CancelledByUser);
    EXPECT_EQ(attempt.unguided_calls, 0);
    EXPECT_TRUE(attempt.reasons.empty());
}

TEST(Fallback, ThrowsTheReasonItselfWhereThereIsNone) {
    Attempt attempt;
    EXPECT_THROW(attempt.run(false, fail), NoPath);
    EXPECT_THROW(attempt.run(false, []() -> int { throw Cancelled("stop"); }), Cancelled);
    EXPECT_EQ(attempt.run(false, [] { return 1; }), 1);
    EXPECT_EQ(attempt.unguided_calls, 0);
    EXPECT_TRUE(attempt.reasons.empty());
}

TEST(Fallback, LetsErrorsOfTheUnguidedAttemptPass) {
    const auto run = [] {
        return with_fallback(
            true, [] { return recoverable<>(fail); }, []() -> int { throw Cancelled("stop"); },
            [](const char*) {});
    };
    EXPECT_THROW(run(), Cancelled);
}

TEST(Fallback, ThrowsAFailureWithoutReasonAsItIs) {
    const auto guided = []() -> int { throw GuidanceFailed("why ever"); };
    EXPECT_THROW(
        with_fallback(false, guided, [] { return 2; }, [](const char*) {}), GuidanceFailed);
}

TEST(Fallback, TellsTypesOfErrorsApart) {
    EXPECT_TRUE((is_one_of<NoPath, Cancelled>(Cancelled(""))));
    EXPECT_TRUE((is_one_of<NoPath, Cancelled>(CancelledByUser(""))));
    EXPECT_FALSE((is_one_of<NoPath, CancelledByUser>(Cancelled(""))));
    EXPECT_FALSE(is_one_of<>(NoPath("")));
}

}  // namespace
}  // namespace planformer_nav2
