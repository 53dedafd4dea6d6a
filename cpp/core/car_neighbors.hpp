/// Nearest neighbours of a car's states.
#pragma once

#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/datastructures/NearestNeighbors.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace planformer {

/// Exact neighbours under a distance that is at least the straight line's, as a curve's length is.
///
/// The length of a car's shortest curve is expensive and no metric. For such distances OMPL's own
/// structures take the best of a few elements for the nearest one, from which the way is often
/// blocked, and compute all distances to find the k nearest. Here elements are looked at in the
/// order of their straight lines, which are cheap, until these are longer than the best curves.
///
/// \tparam T  pointer to a planner's motion, which has a `state` of SE(2)
template <typename T>
class CarNeighbors : public ompl::NearestNeighbors<T> {
public:
    using ompl::NearestNeighbors<T>::add;

    bool reportsSortedResults() const override { return true; }
    std::size_t size() const override { return elements_.size(); }
    void list(std::vector<T>& elements) const override { elements = elements_; }

    void clear() override {
        elements_.clear();
        positions_.clear();
    }

    void add(const T& element) override {
        elements_.push_back(element);
        positions_.push_back(position(element));
    }

    bool remove(const T& element) override {
        const auto found = std::find(elements_.begin(), elements_.end(), element);
        if (found == elements_.end()) return false;
        positions_.erase(positions_.begin() + (found - elements_.begin()));
        elements_.erase(found);
        return true;
    }

    T nearest(const T& element) const override {
        std::vector<T> found;
        nearestK(element, 1, found);
        if (found.empty()) throw ompl::Exception("no elements to find the nearest of");
        return found.front();
    }

    void nearestK(const T& element, std::size_t k, std::vector<T>& found) const override {
        search(element, k, std::numeric_limits<double>::infinity(), &found);
    }

    void nearestR(const T& element, double radius, std::vector<T>& found) const override {
        search(element, elements_.size(), radius, &found);
    }

private:
    struct Position {
        double x;
        double y;
    };

    /// A distance [m] and an element's index: of equally distant elements the first wins.
    using Ranked = std::pair<double, std::size_t>;

    /// Rounding must not make a straight line longer than a curve along it [m].
    static constexpr double kTolerance = 1e-9;

    static Position position(const T& element) {
        const auto* pose = element->state->template as<ompl::base::SE2StateSpace::StateType>();
        return {pose->getX(), pose->getY()};
    }

    /// Finds the k nearest elements within a radius, sorted.
    void search(const T& element, std::size_t k, double radius, std::vector<T>* found) const {
        rank_by_straight_line(element);
        std::vector<Ranked> best;  // a heap, the worst on top
        while (k > 0 && !candidates_.empty()) {
            std::pop_heap(candidates_.begin(), candidates_.end(), std::greater<>());
            const auto [squared, index] = candidates_.back();
            candidates_.pop_back();
            const double reach = best.size() < k ? radius : std::min(radius, best.front().first);
            if (std::sqrt(squared) > reach + kTolerance) break;
            best.emplace_back(this->distFun_(elements_[index], element), index);
            std::push_heap(best.begin(), best.end());
            if (best.size() > k || best.front().first > radius) {
                std::pop_heap(best.begin(), best.end());
                best.pop_back();
            }
        }
        std::sort_heap(best.begin(), best.end());
        found->clear();
        for (const Ranked& ranked : best) found->push_back(elements_[ranked.second]);
    }

    /// Makes `candidates_` a heap of all elements with their squared straight distances, the
    /// closest on top.
    void rank_by_straight_line(const T& element) const {
        const Position from = position(element);
        candidates_.resize(positions_.size());
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            const double dx = positions_[i].x - from.x;
            const double dy = positions_[i].y - from.y;
            candidates_[i] = {dx * dx + dy * dy, i};
        }
        std::make_heap(candidates_.begin(), candidates_.end(), std::greater<>());
    }

    std::vector<T> elements_;
    std::vector<Position> positions_;
    mutable std::vector<Ranked> candidates_;  ///< of the current search; keeps its memory
};

}  // namespace planformer
