/// Compares CarNeighbors with a search through all elements, on random poses of a Dubins car.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/car_neighbors.hpp"
#include "core/car_space.hpp"

namespace {

using planformer::CarSpace;
using planformer::kPi;
using planformer::Pose;

/// As a planner has it.
struct Motion {
    ompl::base::State* state;
};
using Motions = std::vector<Motion*>;
using Neighbors = planformer::CarNeighbors<Motion*>;

void require(bool holds, const char* what, std::size_t round) {
    if (holds) return;
    std::fprintf(stderr, "round %zu: %s\n", round, what);
    std::exit(1);
}

/// Motions at random poses; every fifth is where the last one is, every fifteenth is the same pose.
class Tree {
public:
    Tree(std::size_t count, double side, std::mt19937& random) : motions_(count) {
        std::uniform_real_distribution<double> place(0.0, side);
        std::uniform_real_distribution<double> yaw(-kPi, kPi);
        Pose pose;
        for (std::size_t i = 0; i < count; ++i) {
            if (i % 5 != 1) pose = {place(random), place(random), pose.yaw};
            if (i % 15 != 1) pose.yaw = yaw(random);
            motions_[i].state = space_.allocState();
            CarSpace::set_pose(pose, motions_[i].state);
        }
    }
    ~Tree() {
        for (const Motion& motion : motions_) space_.freeState(motion.state);
    }
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;

    double distance(const Motion* from, const Motion* to) const {
        return space_.distance(from->state, to->state);
    }
    Motion* operator[](std::size_t index) { return &motions_[index]; }

private:
    CarSpace space_{0.55, false};
    std::vector<Motion> motions_;
};

/// The k nearest of some elements within a radius, in the order of distance and of addition.
Motions brute_force(const Tree& tree, Motions elements, const Motion* query, std::size_t k,
                    double radius) {
    std::stable_sort(elements.begin(), elements.end(), [&](const Motion* a, const Motion* b) {
        return tree.distance(a, query) < tree.distance(b, query);
    });
    Motions found;
    for (Motion* element : elements) {
        if (found.size() < k && tree.distance(element, query) <= radius) found.push_back(element);
    }
    return found;
}

void check(std::size_t round, std::mt19937& random) {
    const double unlimited = std::numeric_limits<double>::infinity();
    const std::size_t count = 1 + random() % 300;
    Tree tree(count + 1, round % 2 == 0 ? 1.0 : 20.0, random);
    Motion* const query = tree[count];
    Neighbors neighbors;
    neighbors.setDistanceFunction(
        [&](Motion* const& from, Motion* const& to) { return tree.distance(from, to); });
    Motions elements;
    for (std::size_t i = 0; i < count; ++i) {
        neighbors.add(tree[i]);
        elements.push_back(tree[i]);
    }
    for (std::size_t i = 0; i < count / 4; ++i) {
        const auto removed = elements.begin() + static_cast<long>(random() % elements.size());
        require(neighbors.remove(*removed), "an element cannot be removed", round);
        elements.erase(removed);
    }
    require(!neighbors.remove(query), "what was not added can be removed", round);
    Motions found;
    neighbors.list(found);
    require(found == elements && neighbors.size() == elements.size(), "elements differ", round);
    require(neighbors.nearest(query) == brute_force(tree, elements, query, 1, unlimited).front(),
            "the nearest differs", round);
    for (const std::size_t k : {std::size_t{0}, std::size_t{7}, count + 1}) {
        neighbors.nearestK(query, k, found);
        require(found == brute_force(tree, elements, query, k, unlimited), "the k nearest differ",
                round);
    }
    for (const double radius : {0.0, 3.0, 10.0}) {
        neighbors.nearestR(query, radius, found);
        require(found == brute_force(tree, elements, query, count, radius),
                "those within a radius differ", round);
    }
    neighbors.clear();
    require(neighbors.size() == 0, "clearing leaves elements", round);
    try {
        neighbors.nearest(query);
        require(false, "no elements have a nearest", round);
    } catch (const ompl::Exception&) {}
}

}  // namespace

int main() {
    std::mt19937 random(1);
    constexpr std::size_t kRounds = 2000;
    for (std::size_t round = 0; round < kRounds; ++round) check(round, random);
    std::printf("%zu rounds passed\n", kRounds);
    return 0;
}
