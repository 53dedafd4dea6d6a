// Runs the plugin's own code on the stand-ins of test/interfaces.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <thread>

#include "plugin_fixture.hpp"

namespace planformer_nav2 {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

using MPTPlannerTest = PluginTest;

/// Lets the planner fail in the region and find a path of two poses in the whole map.
template <typename Error>
void fail_in_the_region(const Error& error) {
    FakePlanner::record().plan = [error](const CancelChecker&) {
        if (FakePlanner::record().costmaps.size() == 1) throw error;
        return path_of_length(2);
    };
}

TEST_F(MPTPlannerTest, PlansInTheRegion) {
    serve(region());
    EXPECT_EQ(plan().poses.size(), 1U);
    EXPECT_EQ(seen(), std::vector<Cells>{masked_costmap()});
    EXPECT_EQ(cells(), whole_costmap());
    EXPECT_EQ(pending_requests(), 0U);
}

TEST_F(MPTPlannerTest, DescribesTheCostmapToTheService) {
    set("guide", std::string("mpt"));
    serve(region());
    plan();
    EXPECT_EQ(request_.header.frame_id, "map");
    EXPECT_EQ(request_.header.stamp.sec, 12);
    EXPECT_EQ(request_.info.width, kWidth);
    EXPECT_EQ(request_.info.height, kHeight);
    EXPECT_EQ(request_.info.resolution, 0.5F);
    EXPECT_EQ(request_.info.origin.position.x, -1.0);
    EXPECT_EQ(request_.info.origin.position.y, 2.0);
    EXPECT_EQ(request_.info.origin.orientation.w, 1.0);
    EXPECT_EQ(request_.costs, whole_costmap());
    EXPECT_EQ(request_.start.position.x, start_.pose.position.x);
    EXPECT_EQ(request_.goal.position.y, goal_.pose.position.y);
    EXPECT_EQ(request_.guide, "mpt");
}

TEST_F(MPTPlannerTest, KeepsDiscsRoundStartAndGoal) {
    set("keep_radius", 0.5);
    serve(region());
    plan();
    Cells expected = masked_costmap();
    expected[1] = 0;   // right of the start
    expected[17] = 0;  // below the goal
    EXPECT_EQ(seen(), std::vector<Cells>{expected});
}

TEST_F(MPTPlannerTest, KeepsUnknownCellsThatThePlannerNeverEnters) {
    serve(region());
    plan();
    node_->set_parameter("MPT.planner.allow_unknown", false);
    plan();
    ASSERT_EQ(seen().size(), 2U);
    EXPECT_EQ(seen()[0][16], 253);
    EXPECT_EQ(seen()[1][16], 255);
}

TEST_F(MPTPlannerTest, PlansWithoutARegionWhereThereIsNoService) {
    EXPECT_EQ(plan().poses.size(), 1U);
    EXPECT_EQ(seen(), std::vector<Cells>{whole_costmap()});
    EXPECT_EQ(rclcpp::log_lines().back(),
              "MPT plans without a region: there is no service propose_region");
}

TEST_F(MPTPlannerTest, PlansWithoutARegionWhereNoAnswerComes) {
    set("proposal_timeout", 0.02);
    keep_requests();
    EXPECT_EQ(plan().poses.size(), 1U);
    EXPECT_EQ(seen(), std::vector<Cells>{whole_costmap()});
    EXPECT_EQ(cells(), whole_costmap());
    EXPECT_EQ(pending_requests(), 0U);
}

TEST_F(MPTPlannerTest, DropsAnAnswerThatComesTooLate) {
    set("proposal_timeout", 0.02);
    keep_requests();
    plan();
    ASSERT_EQ(answers_.size(), 1U);
    Service::Response late;
    late.mask.assign(kWidth * kHeight, 0);
    answers_[0](late);

    serve(region());
    plan();
    EXPECT_EQ(seen(), (std::vector<Cells>{whole_costmap(), masked_costmap()}));
    EXPECT_EQ(cells(), whole_costmap());
}

TEST_F(MPTPlannerTest, WaitsForAnAnswerFromAnotherThread) {
    std::thread server;
    rclcpp::server<Service>().handler = [&server](const auto&, const Answer& answer) {
        server = std::thread([answer] { answer(region()); });
    };
    plan();
    server.join();
    EXPECT_EQ(seen(), std::vector<Cells>{masked_costmap()});
}

TEST_F(MPTPlannerTest, PlansWithoutARegionAfterAnError) {
    // Of start and goal, too: the planner has the last word.
    for (std::uint16_t code = 200; code <= 208; ++code) {
        FakePlanner::record().costmaps.clear();
        serve(failure(code, "no region"));
        EXPECT_EQ(plan().poses.size(), 1U);
        EXPECT_EQ(seen(), std::vector<Cells>{whole_costmap()});
        EXPECT_EQ(cells(), whole_costmap());
        EXPECT_EQ(rclcpp::log_lines().back(),
                  "MPT plans without a region: propose_region: no region");
    }
}

TEST_F(MPTPlannerTest, PlansWithoutARegionOfTheWrongSize) {
    for (const std::size_t size : {0, 23, 25}) {
        FakePlanner::record().costmaps.clear();
        Service::Response response;
        response.mask.assign(size, 1);
        serve(response);
        EXPECT_EQ(plan().poses.size(), 1U);
        EXPECT_EQ(seen(), std::vector<Cells>{whole_costmap()});
        EXPECT_EQ(cells(), whole_costmap());
    }
}

TEST_F(MPTPlannerTest, PlansWithoutARegionInAnEmptyCostmap) {
    costmap().resizeMap(0, 0, 0.5, 0.0, 0.0);
    serve(region());
    EXPECT_EQ(plan().poses.size(), 1U);
    EXPECT_EQ(seen(), std::vector<Cells>{Cells{}});
}

TEST_F(MPTPlannerTest, PlansWithoutARegionWhenShutDownMeanwhile) {
    keep_requests();
    const auto shut_down = [] {
        rclcpp::running() = false;
        return false;
    };
    EXPECT_EQ(plan(shut_down).poses.size(), 1U);
    EXPECT_EQ(seen(), std::vector<Cells>{whole_costmap()});
}

TEST_F(MPTPlannerTest, IsCancelledWhileItWaits) {
    keep_requests();
    int looks = 0;
    EXPECT_THROW(plan([&looks] { return ++looks == 3; }), nav2_core::PlannerCancelled);
    EXPECT_TRUE(seen().empty());
    EXPECT_EQ(pending_requests(), 0U);
    EXPECT_EQ(cells(), whole_costmap());
}

TEST_F(MPTPlannerTest, IsCancelledWhileItPlans) {
    serve(region());
    bool planning = false;
    FakePlanner::record().plan = [&planning](const CancelChecker& cancelled) -> Path {
        planning = true;
        if (cancelled()) throw nav2_core::PlannerCancelled("stop");
        return path_of_length(1);
    };
    EXPECT_THROW(plan([&planning] { return planning; }), nav2_core::PlannerCancelled);
    EXPECT_EQ(seen(), std::vector<Cells>{masked_costmap()});
    EXPECT_EQ(cells(), whole_costmap());
}

TEST_F(MPTPlannerTest, DoesNotMaskACostmapThatChangedMeanwhile) {
    struct Change {
        unsigned int width;
        unsigned int height;
        double resolution;
        double origin_x;
        double origin_y;
    };
    const std::vector<Change> changes = {{7, 4, 0.5, -1.0, 2.0},
                                         {4, 6, 0.5, -1.0, 2.0},
                                         {6, 4, 0.25, -1.0, 2.0},
                                         {6, 4, 0.5, -0.5, 2.0},
                                         {6, 4, 0.5, -1.0, 2.5}};
    for (const Change& change : changes) {
        FakePlanner::record().costmaps.clear();
        costmap().resizeMap(kWidth, kHeight, 0.5, -1.0, 2.0);
        rclcpp::server<Service>().handler = [&](const auto&, const Answer& answer) {
            costmap().resizeMap(change.width, change.height, change.resolution, change.origin_x,
                                change.origin_y);
            answer(region());
        };
        EXPECT_EQ(plan().poses.size(), 1U);
        EXPECT_EQ(seen(), std::vector<Cells>{Cells(change.width * change.height, 0)});
        EXPECT_EQ(rclcpp::log_lines().back(),
                  "MPT plans without a region: the costmap was moved or resized meanwhile");
    }
}

TEST_F(MPTPlannerTest, SeesAnObstacleThatAppearedMeanwhile) {
    rclcpp::server<Service>().handler = [&](const auto&, const Answer& answer) {
        costmap().getCharMap()[6] = 254;
        answer(region());
    };
    plan();
    Cells expected = masked_costmap();
    expected[6] = 254;
    EXPECT_EQ(seen(), std::vector<Cells>{expected});
    EXPECT_EQ(cells()[6], 254);
}

template <typename Error>
class RecoverableErrorTest : public PluginTest {};

using RecoverableErrors =
    testing::Types<nav2_core::NoValidPathCouldBeFound, nav2_core::PlannerTimedOut,
                   nav2_core::PlannerException, std::runtime_error>;
TYPED_TEST_SUITE(RecoverableErrorTest, RecoverableErrors);

TYPED_TEST(RecoverableErrorTest, TriesTheWholeMap) {
    this->serve(this->region());
    fail_in_the_region(TypeParam("failed"));
    EXPECT_EQ(this->plan().poses.size(), 2U);
    EXPECT_EQ(this->seen(), (std::vector<Cells>{this->masked_costmap(), this->whole_costmap()}));
    EXPECT_EQ(this->cells(), this->whole_costmap());
    EXPECT_EQ(rclcpp::log_lines().back(), "MPT plans without a region: failed");
}

TYPED_TEST(RecoverableErrorTest, IsThrownWithoutFallback) {
    this->set("fallback", false);
    this->serve(this->region());
    fail_in_the_region(TypeParam("failed"));
    EXPECT_THROW(this->plan(), TypeParam);
    EXPECT_EQ(this->seen(), std::vector<Cells>{this->masked_costmap()});
    EXPECT_EQ(this->cells(), this->whole_costmap());
}

template <typename Error>
class FinalErrorTest : public PluginTest {};

using FinalErrors =
    testing::Types<nav2_core::PlannerCancelled, nav2_core::PlannerTFError, nav2_core::StartOccupied,
                   nav2_core::GoalOccupied, nav2_core::StartOutsideMapBounds,
                   nav2_core::GoalOutsideMapBounds>;
TYPED_TEST_SUITE(FinalErrorTest, FinalErrors);

TYPED_TEST(FinalErrorTest, IsThrown) {
    this->serve(this->region());
    fail_in_the_region(TypeParam("failed"));
    EXPECT_THROW(this->plan(), TypeParam);
    EXPECT_EQ(this->seen(), std::vector<Cells>{this->masked_costmap()});
    EXPECT_EQ(this->cells(), this->whole_costmap());
}

TEST_F(MPTPlannerTest, TakesAnEmptyPathForAFailure) {
    serve(region());
    FakePlanner::record().plan = [](const CancelChecker&) {
        return path_of_length(FakePlanner::record().costmaps.size() - 1);
    };
    EXPECT_EQ(plan().poses.size(), 1U);
    EXPECT_EQ(seen(), (std::vector<Cells>{masked_costmap(), whole_costmap()}));
}

TEST_F(MPTPlannerTest, ThrowsWhatFailsInTheWholeMap) {
    serve(region());
    FakePlanner::record().plan = [](const CancelChecker&) -> Path {
        throw nav2_core::NoValidPathCouldBeFound("none");
    };
    EXPECT_THROW(plan(), nav2_core::NoValidPathCouldBeFound);
    EXPECT_EQ(seen(), (std::vector<Cells>{masked_costmap(), whole_costmap()}));
    EXPECT_EQ(cells(), whole_costmap());
}

TEST_F(MPTPlannerTest, RestoresWhatThePlannerWrites) {
    serve(region());
    FakePlanner::record().plan = [this](const CancelChecker&) {
        costmap().getCharMap()[0] = 77;
        costmap().getCharMap()[15] = 0;
        return path_of_length(1);
    };
    plan();
    EXPECT_EQ(cells(), whole_costmap());
}

TEST_F(MPTPlannerTest, HidesTheMaskFromOtherThreads) {
    serve(region());
    bool could_lock = true;
    FakePlanner::record().plan = [&](const CancelChecker&) {
        std::thread([&] { could_lock = costmap().getMutex()->try_lock(); }).join();
        return path_of_length(1);
    };
    plan();
    EXPECT_FALSE(could_lock);
    std::thread([&] {
        could_lock = costmap().getMutex()->try_lock();
        if (could_lock) costmap().getMutex()->unlock();
    }).join();
    EXPECT_TRUE(could_lock);
}

TEST_F(MPTPlannerTest, DoesNotLockTheCostmapWhileItWaits) {
    bool could_lock = false;
    rclcpp::server<Service>().handler = [&](const auto&, const Answer& answer) {
        std::thread([&] {
            could_lock = costmap().getMutex()->try_lock();
            if (could_lock) costmap().getMutex()->unlock();
        }).join();
        answer(region());
    };
    plan();
    EXPECT_TRUE(could_lock);
}

TEST_F(MPTPlannerTest, ThrowsNav2sExceptionsOfTheServiceWithoutFallback) {
    set("fallback", false);
    configure();
    const auto plan_after = [this](std::uint16_t code) {
        serve(failure(code, "why"));
        plan();
    };
    EXPECT_THROW(plan_after(200), nav2_core::PlannerException);
    EXPECT_THROW(plan_after(201), nav2_core::InvalidPlanner);
    EXPECT_THROW(plan_after(202), nav2_core::PlannerTFError);
    EXPECT_THROW(plan_after(203), nav2_core::StartOutsideMapBounds);
    EXPECT_THROW(plan_after(204), nav2_core::GoalOutsideMapBounds);
    EXPECT_THROW(plan_after(205), nav2_core::StartOccupied);
    EXPECT_THROW(plan_after(206), nav2_core::GoalOccupied);
    EXPECT_THROW(plan_after(207), nav2_core::PlannerTimedOut);
    EXPECT_THROW(plan_after(208), nav2_core::NoValidPathCouldBeFound);
    EXPECT_THROW(plan_after(9), nav2_core::PlannerException);
    EXPECT_TRUE(seen().empty());
}

TEST_F(MPTPlannerTest, ThrowsForWantOfARegionWithoutFallback) {
    set("fallback", false);
    set("proposal_timeout", 0.02);
    EXPECT_THROW(plan(), nav2_core::PlannerException);
    keep_requests();
    EXPECT_THROW(plan(), nav2_core::PlannerTimedOut);
    EXPECT_TRUE(seen().empty());
}

TEST_F(MPTPlannerTest, CallsTheServiceOfItsParameter) {
    set("service", std::string("/robot/regions"));
    rclcpp::server<Service>().name = "/robot/regions";
    serve(region());
    plan();
    EXPECT_EQ(seen(), std::vector<Cells>{masked_costmap()});
}

TEST_F(MPTPlannerTest, ConfiguresThePlannerBelowItsOwnName) {
    configure();
    EXPECT_EQ(FakePlanner::record().name, "MPT.planner");
    EXPECT_EQ(FakePlanner::record().tf, tf_);
}

TEST_F(MPTPlannerTest, ForwardsTheLifecycle) {
    serve(region());
    configure();
    planner_->activate();
    plan();
    planner_->deactivate();
    planner_->cleanup();
    EXPECT_EQ(FakePlanner::record().lifecycle,
              (std::vector<std::string>{"configure", "activate", "deactivate", "cleanup"}));
}

// The node keeps the declared parameters.
TEST_F(MPTPlannerTest, CanBeConfiguredAgain) {
    serve(region());
    plan();
    planner_->cleanup();
    planner_->configure(node_, "MPT", tf_, costmap_ros_);
    plan();
    planner_->cleanup();
    configure();
    plan();
    EXPECT_EQ(seen(), std::vector<Cells>(3, masked_costmap()));
}

TEST_F(MPTPlannerTest, MayBeDestroyedWithoutCleanup) {
    configure();
    planner_.reset();
    EXPECT_EQ(FakePlanner::record().lifecycle, std::vector<std::string>{"configure"});
}

TEST_F(MPTPlannerTest, AsksForThePlannerToGuide) {
    set("planner.plugin", std::string());
    try {
        configure();
        FAIL();
    } catch (const nav2_core::PlannerException& error) {
        EXPECT_STREQ(error.what(), "set MPT.planner.plugin to the planner that is to be guided");
    }
    node_ = std::make_shared<Node>();
    set("planner.plugin", std::string("no::Such"));
    EXPECT_THROW(configure(), std::runtime_error);
}

TEST_F(MPTPlannerTest, RefusesParametersOutOfRange) {
    const std::vector<std::pair<std::string, double>> wrong = {
        {"proposal_timeout", 0.0},       {"proposal_timeout", -1.0}, {"proposal_timeout", 61.0},
        {"proposal_timeout", kNoNumber}, {"keep_radius", -0.1},      {"keep_radius", kNoNumber}};
    for (const auto& [name, value] : wrong) {
        node_ = std::make_shared<Node>();
        set(name, value);
        EXPECT_THROW(configure(), nav2_core::PlannerException);
    }
}

TEST_F(MPTPlannerTest, FollowsItsParameters) {
    serve(region());
    plan();
    node_->set_parameter("MPT.guide", std::string("mpt"));
    node_->set_parameter("MPT.keep_radius", 0.5);
    plan();
    EXPECT_EQ(request_.guide, "mpt");
    ASSERT_EQ(seen().size(), 2U);
    EXPECT_EQ(seen()[1][1], 0);  // right of the start

    node_->set_parameter("MPT.fallback", false);
    node_->set_parameter("MPT.proposal_timeout", 0.02);
    keep_requests();
    EXPECT_THROW(plan(), nav2_core::PlannerTimedOut);
}

TEST_F(MPTPlannerTest, RefusesChangesOutOfRange) {
    configure();
    EXPECT_EQ(node_->set_parameter("MPT.proposal_timeout", -3.0).reason,
              "MPT.proposal_timeout has to be above 0 s and at most 60 s");
    for (const double value : {-0.1, kNoNumber}) {
        EXPECT_FALSE(node_->set_parameter("MPT.keep_radius", value).successful);
    }
    EXPECT_TRUE(node_->set_parameter("MPT.planner.allow_unknown", false).successful);
    planner_->cleanup();
    EXPECT_TRUE(node_->set_parameter("MPT.keep_radius", -0.1).successful);  // not its own any more
}

// Who sets a parameter holds them all and waits for a lock that a planner server holds here.
TEST_F(MPTPlannerTest, DoesNotAskForParametersWhileItPlans) {
    serve(region());
    configure();
    const int before = node_->lookups();
    fail_in_the_region(nav2_core::NoValidPathCouldBeFound("none"));
    plan();
    EXPECT_EQ(seen().size(), 2U);
    EXPECT_EQ(node_->lookups(), before);
}

TEST_F(MPTPlannerTest, RefusesAParentThatIsGone) {
    node_.reset();
    EXPECT_THROW(configure(), nav2_core::PlannerException);
}

TEST(PluginDescription, NamesTheExportedClass) {
    std::ifstream file(PLANFORMER_NAV2_DIR "/plugins.xml");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(text.find("type=\"planformer_nav2::MPTPlanner\""), std::string::npos);
    EXPECT_NE(text.find("base_class_type=\"nav2_core::GlobalPlanner\""), std::string::npos);
    EXPECT_NE(text.find("<library path=\"planformer_nav2\">"), std::string::npos);
    EXPECT_EQ(pluginlib::registry<nav2_core::GlobalPlanner>().count("planformer_nav2::MPTPlanner"),
              1U);
}

#ifdef PLANFORMER_NAV2_LYRICAL
TEST_F(MPTPlannerTest, LeavesViapointsToThePlannerAlone) {
    serve(region());
    viapoints_ = {pose_at(0.0, 2.5), pose_at(0.5, 3.0)};
    EXPECT_EQ(plan().poses.size(), 1U);
    EXPECT_EQ(seen(), std::vector<Cells>{whole_costmap()});
    EXPECT_EQ(FakePlanner::record().viapoints.size(), 2U);
    EXPECT_TRUE(request_.costs.empty());
}
#endif

}  // namespace
}  // namespace planformer_nav2

PLUGINLIB_EXPORT_CLASS(planformer_nav2::FakePlanner, nav2_core::GlobalPlanner)
