// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace rclcpp {

enum class CallbackGroupType { MutuallyExclusive, Reentrant };
enum class FutureReturnCode { SUCCESS, INTERRUPTED, TIMEOUT };

/// Whether the program still runs; the tests end it.
inline bool& running() {
    static bool value = true;
    return value;
}

/// Callbacks that wait for an executor.
class CallbackGroup {
public:
    using SharedPtr = std::shared_ptr<CallbackGroup>;

    explicit CallbackGroup(bool with_node) : with_node_(with_node) {}
    bool automatically_add_to_executor_with_node() const { return with_node_; }

    void push(std::function<void()> callback) {
        const std::lock_guard<std::mutex> lock(mutex_);
        callbacks_.push_back(std::move(callback));
    }

    void run_all() {
        std::deque<std::function<void()>> callbacks;
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            callbacks.swap(callbacks_);
        }
        for (const auto& callback : callbacks) callback();
    }

private:
    bool with_node_;
    std::mutex mutex_;
    std::deque<std::function<void()>> callbacks_;
};

namespace node_interfaces {

struct NodeBaseInterface {
    using SharedPtr = std::shared_ptr<NodeBaseInterface>;
};

}  // namespace node_interfaces

namespace executors {

class SingleThreadedExecutor {
public:
    void add_callback_group(const CallbackGroup::SharedPtr& group,
                            const node_interfaces::NodeBaseInterface::SharedPtr&) {
        if (group->automatically_add_to_executor_with_node()) {
            throw std::runtime_error("the group belongs to its node's executor");
        }
        groups_.push_back(group);
    }

    template <typename Future>
    FutureReturnCode spin_until_future_complete(const Future& future,
                                                std::chrono::nanoseconds timeout) {
        const auto deadline = std::chrono::steady_clock::now() + timeout;
        while (running()) {
            for (const auto& group : groups_) group->run_all();
            if (future.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
                return FutureReturnCode::SUCCESS;
            }
            if (std::chrono::steady_clock::now() >= deadline) return FutureReturnCode::TIMEOUT;
            std::this_thread::sleep_for(std::chrono::microseconds(100));
        }
        return FutureReturnCode::INTERRUPTED;
    }

private:
    std::vector<CallbackGroup::SharedPtr> groups_;
};

}  // namespace executors

}  // namespace rclcpp
