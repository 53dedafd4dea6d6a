// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <rclcpp/executors.hpp>
#include <string>
#include <utility>

namespace rclcpp {

class QoS {};
class ServicesQoS : public QoS {};

/// The only service of a type, for the tests to play; without a handler there is none.
template <typename ServiceT>
struct Server {
    using Answer = std::function<void(typename ServiceT::Response)>;
    std::string name;
    std::function<void(typename ServiceT::Request::SharedPtr, Answer)> handler;
};

template <typename ServiceT>
Server<ServiceT>& server() {
    static Server<ServiceT> value;
    return value;
}

template <typename ServiceT>
class Client : public std::enable_shared_from_this<Client<ServiceT>> {
public:
    using SharedPtr = std::shared_ptr<Client>;
    using SharedRequest = typename ServiceT::Request::SharedPtr;
    using SharedResponse = typename ServiceT::Response::SharedPtr;

    struct FutureAndRequestId {
        std::future<SharedResponse> future;
        std::int64_t request_id;

        SharedResponse get() { return future.get(); }
        std::future_status wait_for(std::chrono::nanoseconds time) const {
            return future.wait_for(time);
        }
    };

    Client(std::string name, CallbackGroup::SharedPtr group)
        : name_(std::move(name)), group_(std::move(group)) {}

    bool service_is_ready() const {
        return server<ServiceT>().handler && server<ServiceT>().name == name_;
    }

    FutureAndRequestId async_send_request(const SharedRequest& request) {
        const std::int64_t id = next_id_++;
        FutureAndRequestId answer{pending_[id].get_future(), id};
        server<ServiceT>().handler(
            request, [client = this->shared_from_this(), id](typename ServiceT::Response response) {
                client->group_->push([client, id, response] { client->receive(id, response); });
            });
        return answer;
    }

    bool remove_pending_request(const FutureAndRequestId& answer) {
        return pending_.erase(answer.request_id) > 0;
    }

    std::size_t pending_count() const { return pending_.size(); }

private:
    void receive(std::int64_t id, const typename ServiceT::Response& response) {
        const auto found = pending_.find(id);
        if (found == pending_.end()) return;
        found->second.set_value(std::make_shared<typename ServiceT::Response>(response));
        pending_.erase(found);
    }

    std::string name_;
    CallbackGroup::SharedPtr group_;
    std::int64_t next_id_ = 0;
    std::map<std::int64_t, std::promise<SharedResponse>> pending_;
};

/// The client that was made last, for the tests to look at.
template <typename ServiceT>
std::weak_ptr<Client<ServiceT>>& last_client() {
    static std::weak_ptr<Client<ServiceT>> value;
    return value;
}

}  // namespace rclcpp
