#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <nav2_core/global_planner.hpp>
#include <nav2_core/planner_exceptions.hpp>
#include <pluginlib/class_list_macros.hpp>
#include <pluginlib/class_loader.hpp>
#include <string>
#include <vector>

#include "planformer_nav2/nav2_interface.hpp"
#include "planformer_nav2/region_client.hpp"

namespace planformer_nav2 {

using Service = RegionClient::Service;
using Answer = rclcpp::Server<Service>::Answer;
using Cells = std::vector<unsigned char>;

/// The planner that the plugin guides; what it does and what it saw belongs to the test.
class FakePlanner : public nav2_core::GlobalPlanner {
public:
    struct Record {
        std::vector<std::string> lifecycle;
        std::string name;
        std::shared_ptr<TransformBuffer> tf;
        std::vector<Cells> costmaps;  ///< at each call of createPlan
        std::vector<PoseStamped> viapoints;
        std::function<Path(const CancelChecker&)> plan;
    };

    static Record& record() {
        static Record value;
        return value;
    }

    void configure(const Node::WeakPtr& parent, std::string name,
                   std::shared_ptr<TransformBuffer> tf,
                   std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_ros) override {
        const auto node = parent.lock();
        const std::string allow_unknown = name + ".allow_unknown";
        if (!node->has_parameter(allow_unknown)) node->declare_parameter(allow_unknown, true);
        record().lifecycle.emplace_back("configure");
        record().name = name;
        record().tf = tf;
        costmap_ros_ = costmap_ros;
    }
    void cleanup() override { record().lifecycle.emplace_back("cleanup"); }
    void activate() override { record().lifecycle.emplace_back("activate"); }
    void deactivate() override { record().lifecycle.emplace_back("deactivate"); }

#ifdef PLANFORMER_NAV2_LYRICAL
    Path createPlan(const PoseStamped& /*start*/, const PoseStamped& /*goal*/,
                    const std::vector<PoseStamped>& viapoints,
                    std::function<bool()> cancel_checker) override {
        record().viapoints = viapoints;
        return plan(cancel_checker);
    }
#else
    Path createPlan(const PoseStamped& /*start*/, const PoseStamped& /*goal*/,
                    std::function<bool()> cancel_checker) override {
        return plan(cancel_checker);
    }
#endif

private:
    Path plan(const CancelChecker& cancelled) {
        nav2_costmap_2d::Costmap2D& costmap = *costmap_ros_->getCostmap();
        // As Nav2's planners do, under a lock that the plugin may hold already.
        const std::lock_guard<nav2_costmap_2d::Costmap2D::mutex_t> lock(*costmap.getMutex());
        const std::size_t count =
            std::size_t{costmap.getSizeInCellsX()} * costmap.getSizeInCellsY();
        record().costmaps.emplace_back(costmap.getCharMap(), costmap.getCharMap() + count);
        return record().plan(cancelled);
    }

    std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_ros_;
};

/// A path that tells by which call of the planner it was made.
inline Path path_of_length(std::size_t length) {
    Path path;
    path.poses.resize(length);
    return path;
}

/// A planner server of 6 x 4 cells of half a metre: free, with a wall of every kind of cost.
class PluginTest : public testing::Test {
protected:
    static constexpr unsigned int kWidth = 6;
    static constexpr unsigned int kHeight = 4;

    void SetUp() override {
        FakePlanner::record() = {};
        FakePlanner::record().plan = [](const CancelChecker&) { return path_of_length(1); };
        rclcpp::server<Service>() = {"propose_region", nullptr};
        rclcpp::log_lines().clear();
        rclcpp::running() = true;

        costmap().resizeMap(kWidth, kHeight, 0.5, -1.0, 2.0);
        const Cells wall = {10, 252, 253, 254, 255, 0};
        std::copy(wall.begin(), wall.end(), costmap().getCharMap() + 2 * kWidth);
        start_ = pose_at(-0.75, 2.25);  // cell 0
        goal_ = pose_at(1.75, 3.75);    // cell 23
        set("planner.plugin", std::string("planformer_nav2::FakePlanner"));
        set("keep_radius", 0.0);
        set("proposal_timeout", 30.0);
    }

    void TearDown() override {
        rclcpp::server<Service>() = {};
        planner_.reset();
        FakePlanner::record() = {};
    }

    void set(const std::string& name, const rclcpp::ParameterValue& value) {
        node_->overrides["MPT." + name] = value;
    }

    void configure() {
        planner_ = loader_.createSharedInstance("planformer_nav2::MPTPlanner");
        planner_->configure(node_, "MPT", tf_, costmap_ros_);
    }

    Path plan(const CancelChecker& cancelled = [] { return false; }) {
        if (planner_ == nullptr) configure();
        return create_plan(*planner_, {start_, goal_, viapoints_, cancelled});
    }

    /// Has the service answer each request at once.
    void serve(const Service::Response& response) {
        rclcpp::server<Service>().handler = [this, response](const auto& request,
                                                             const Answer& answer) {
            request_ = *request;
            answer(response);
        };
    }

    /// Has the service keep each request, for the test to answer.
    void keep_requests() {
        rclcpp::server<Service>().handler = [this](const auto&, const Answer& answer) {
            answers_.push_back(answer);
        };
    }

    /// An answer with the first column and the last row inside.
    static Service::Response region() {
        Service::Response response;
        response.mask.resize(kWidth * kHeight);
        for (unsigned int cell = 0; cell < kWidth * kHeight; ++cell) {
            response.mask[cell] = cell % kWidth == 0 || cell / kWidth == kHeight - 1;
        }
        return response;
    }

    static Service::Response failure(std::uint16_t code, const std::string& message) {
        Service::Response response;
        response.error_code = code;
        response.error_msg = message;
        return response;
    }

    /// What the guided planner sees in that region.
    static Cells masked_costmap() {
        return {0,  253, 253, 253, 253, 253,  //
                0,  253, 253, 253, 253, 253,  //
                10, 253, 253, 254, 253, 253,  //
                0,  0,   0,   0,   0,   0};
    }

    static Cells whole_costmap() {
        return {0,  0,   0,   0,   0,   0,  //
                0,  0,   0,   0,   0,   0,  //
                10, 252, 253, 254, 255, 0,  //
                0,  0,   0,   0,   0,   0};
    }

    nav2_costmap_2d::Costmap2D& costmap() { return *costmap_ros_->getCostmap(); }

    Cells cells() {
        const std::size_t count =
            std::size_t{costmap().getSizeInCellsX()} * costmap().getSizeInCellsY();
        return {costmap().getCharMap(), costmap().getCharMap() + count};
    }

    static const std::vector<Cells>& seen() { return FakePlanner::record().costmaps; }

    static std::size_t pending_requests() {
        return rclcpp::last_client<Service>().lock()->pending_count();
    }

    static PoseStamped pose_at(double x, double y) {
        PoseStamped pose;
        pose.header.frame_id = "map";
        pose.header.stamp.sec = 12;
        pose.pose.position.x = x;
        pose.pose.position.y = y;
        return pose;
    }

    pluginlib::ClassLoader<nav2_core::GlobalPlanner> loader_{"nav2_core",
                                                             "nav2_core::GlobalPlanner"};
    std::shared_ptr<Node> node_ = std::make_shared<Node>();
    std::shared_ptr<TransformBuffer> tf_ = std::make_shared<TransformBuffer>();
    std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_ros_ =
        std::make_shared<nav2_costmap_2d::Costmap2DROS>();
    std::shared_ptr<nav2_core::GlobalPlanner> planner_;
    PoseStamped start_;
    PoseStamped goal_;
    std::vector<PoseStamped> viapoints_;
    Service::Request request_;
    std::vector<Answer> answers_;
};

}  // namespace planformer_nav2
