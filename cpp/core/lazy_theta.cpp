#include "core/lazy_theta.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>

namespace planformer {
namespace {

using Index = std::uint32_t;

/// What moving a vertex must gain at least, in cells, so that rounding never moves it for ever.
constexpr double kLeastGain = 1e-4;

struct Offset {
    int row;
    int col;
};

constexpr Offset kNeighbours[8] = {{0, 1}, {1, 0},  {0, -1},  {-1, 0},
                                   {1, 1}, {1, -1}, {-1, -1}, {-1, 1}};

/// What the search knows of a cell, 8 bytes because memory traffic is most of the cost. All zero
/// means untouched, so that the operating system's zero pages initialise the cells: the memory
/// really used is that of the cells seen.
struct Node {
    float length;       ///< Length of the best path found from the start [m].
    Index parent : 31;  ///< Index of the parent cell + 1; 0 = untouched.
    Index closed : 1;

    /// `cell` < 2^31 - 1.
    void set_parent(Index cell) { parent = (cell + 1) & 0x7fffffffU; }
};

struct FreeMemory {
    void operator()(Node* nodes) const { std::free(nodes); }
};
using Nodes = std::unique_ptr<Node[], FreeMemory>;

Nodes allocate_nodes(std::size_t count) {
    auto* nodes = static_cast<Node*>(std::calloc(count, sizeof(Node)));
    if (nodes == nullptr) {
        throw std::bad_alloc();
    }
    return Nodes(nodes);
}

struct OpenEntry {
    float estimate;  ///< Length from the start + straight line to the goal [m].
    Index index;
};

/// Orders a heap of std::push_heap with the smallest estimate on top.
bool is_worse(const OpenEntry& a, const OpenEntry& b) { return a.estimate > b.estimate; }

double distance(Point a, Point b) {
    const double dx = a.x - b.x;
    const double dy = a.y - b.y;
    return std::sqrt(dx * dx + dy * dy);
}

bool sees(const FreeSpace& space, Point a, Point b) {
    return space.segment_is_free(a.x, a.y, b.x, b.y);
}

/// What may be a cell's parent: the neighbour that it was reached from, or whatever that one's
/// parent is and the cell can see.
enum class Parents { kNeighbours, kAnyAngle };

class Search {
public:
    Search(const FreeSpace& space, Point start, Point goal, Parents parents)
        : space_(space),
          parents_(parents),
          start_(start),
          goal_(goal),
          start_cell_(cell_of(start)),
          goal_cell_(cell_of(goal)),
          nodes_(allocate_nodes(static_cast<std::size_t>(space.height) * space.width)) {}

    /// The vertices as the search leaves them, empty when the goal is out of reach.
    std::vector<Point> run() {
        improve(start_cell_, start_cell_, 0.0, start_);
        while (!open_.empty()) {
            const Index cell = pop();
            if (nodes_[cell].closed) {
                continue;  // a leftover of an estimate that was improved later
            }
            confirm_parent(cell);
            nodes_[cell].closed = 1;
            if (cell == goal_cell_) {
                return trace_back();
            }
            expand(cell);
        }
        return {};
    }

private:
    Index index(int row, int col) const {
        return static_cast<Index>(row) * static_cast<Index>(space_.width) + static_cast<Index>(col);
    }

    Index cell_of(Point p) const {
        return index(static_cast<int>(std::floor(p.y / space_.resolution)),
                     static_cast<int>(std::floor(p.x / space_.resolution)));
    }

    int row(Index cell) const { return static_cast<int>(cell / space_.width); }
    int col(Index cell) const { return static_cast<int>(cell % space_.width); }
    Index parent(Index cell) const { return nodes_[cell].parent - 1; }

    Point point(Index cell) const { return point(cell, row(cell), col(cell)); }

    Point point(Index cell, int row, int col) const {
        if (cell == start_cell_) {
            return start_;
        }
        if (cell == goal_cell_) {
            return goal_;
        }
        return {(col + 0.5) * space_.resolution, (row + 0.5) * space_.resolution};
    }

    /// Whether a step leads from a free cell into the grid without cutting a corner. The segment
    /// between the two cells' points, wherever these lie, then touches free cells only.
    bool is_step(int row, int col, Offset step) const {
        if (!space_.is_free(row + step.row, col + step.col)) {
            return false;
        }
        return step.row == 0 || step.col == 0 ||
               (space_.is_free(row + step.row, col) && space_.is_free(row, col + step.col));
    }

    Index pop() {
        std::pop_heap(open_.begin(), open_.end(), is_worse);
        const Index cell = open_.back().index;
        open_.pop_back();
        return cell;
    }

    void improve(Index cell, Index parent, double length, Point at) {
        Node& node = nodes_[cell];
        node.length = static_cast<float>(length);
        node.set_parent(parent);
        open_.push_back({static_cast<float>(length + distance(at, goal_)), cell});
        std::push_heap(open_.begin(), open_.end(), is_worse);
    }

    /// Lazy Theta*'s SetVertex: `cell` was given the parent of a neighbour on trust; when that
    /// parent can't see it, the best of its expanded neighbours takes the parent's place.
    void confirm_parent(Index cell) {
        const int r = row(cell);
        const int c = col(cell);
        const Index from = parent(cell);
        const Point at = point(cell, r, c);
        if (is_beside(from, r, c) || sees(space_, point(from), at)) {
            return;
        }
        float best = std::numeric_limits<float>::infinity();
        for (const Offset step : kNeighbours) {
            if (!is_step(r, c, step)) {
                continue;
            }
            const Index neighbour = index(r + step.row, c + step.col);
            if (!nodes_[neighbour].closed) {
                continue;
            }
            const Point there = point(neighbour, r + step.row, c + step.col);
            const auto length = static_cast<float>(nodes_[neighbour].length + distance(there, at));
            if (length < best) {
                best = length;
                nodes_[cell].set_parent(neighbour);
            }
        }
        nodes_[cell].length = best;
    }

    /// Whether the parent is the cell itself or straight beside it, and so surely visible.
    bool is_beside(Index from, int r, int c) const {
        return std::abs(row(from) - r) + std::abs(col(from) - c) <= 1;
    }

    void expand(Index cell) {
        const int r = row(cell);
        const int c = col(cell);
        const Index from = parents_ == Parents::kAnyAngle ? parent(cell) : cell;
        const Point origin = point(from);
        const double base = nodes_[from].length;
        for (const Offset step : kNeighbours) {
            if (!is_step(r, c, step)) {
                continue;
            }
            const Index neighbour = index(r + step.row, c + step.col);
            const Node& node = nodes_[neighbour];
            if (node.closed) {
                continue;
            }
            const Point at = point(neighbour, r + step.row, c + step.col);
            const double length = base + distance(origin, at);
            if (node.parent == 0 || static_cast<float>(length) < node.length) {
                improve(neighbour, from, length, at);
            }
        }
    }

    std::vector<Point> trace_back() const {
        std::vector<Point> path{goal_};
        for (Index cell = goal_cell_; cell != start_cell_; cell = parent(cell)) {
            path.push_back(point(parent(cell)));
        }
        std::reverse(path.begin(), path.end());
        return path;
    }

    const FreeSpace& space_;
    const Parents parents_;
    const Point start_;
    const Point goal_;
    const Index start_cell_;
    const Index goal_cell_;
    Nodes nodes_;
    std::vector<OpenEntry> open_;
};

/// From every kept vertex on straight to the last vertex that it sees.
std::vector<Point> shortcut(const FreeSpace& space, const std::vector<Point>& path) {
    std::vector<Point> kept{path.front()};
    for (std::size_t at = 0; at + 1 < path.size();) {
        std::size_t next = path.size() - 1;
        while (next > at + 1 && !sees(space, path[at], path[next])) {
            --next;
        }
        kept.push_back(path[next]);
        at = next;
    }
    return kept;
}

/// The shortest way from `a` to `c` round a neighbour of `b`'s cell, or `b` when no neighbour
/// gains more than rounding.
Point step_towards_taut(const FreeSpace& space, Point a, Point b, Point c) {
    const double res = space.resolution;
    const double row = std::floor(b.y / res) + 0.5;
    const double col = std::floor(b.x / res) + 0.5;
    Point best = b;
    double least = distance(a, b) + distance(b, c) - kLeastGain * res;
    for (const Offset step : kNeighbours) {
        const Point at{(col + step.col) * res, (row + step.row) * res};
        const double length = distance(a, at) + distance(at, c);
        if (length < least && sees(space, a, at) && sees(space, at, c)) {
            least = length;
            best = at;
        }
    }
    return best;
}

/// Moves every inner vertex from cell to cell as long as that makes the path shorter; returns
/// whether one moved.
bool pull_taut(const FreeSpace& space, std::vector<Point>& path) {
    bool moved = false;
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
        for (;;) {
            const Point next = step_towards_taut(space, path[i - 1], path[i], path[i + 1]);
            if (next.x == path[i].x && next.y == path[i].y) {
                break;
            }
            path[i] = next;
            moved = true;
        }
    }
    return moved;
}

/// A path with shortcuts, empty where there is none.
std::vector<Point> find_path(const FreeSpace& space, Point start, Point goal, Parents parents) {
    if (!space.is_free(start.x, start.y) || !space.is_free(goal.x, goal.y)) {
        return {};
    }
    if (sees(space, start, goal)) {
        return {start, goal};  // also keeps the two points' cells apart in the search below
    }
    const std::vector<Point> path = Search(space, start, goal, parents).run();
    return path.empty() ? path : shortcut(space, path);
}

}  // namespace

std::vector<Point> lazy_theta(const FreeSpace& space, Point start, Point goal) {
    std::vector<Point> path = find_path(space, start, goal, Parents::kAnyAngle);
    while (pull_taut(space, path)) {
        path = shortcut(space, path);
    }
    return path;
}

std::vector<Point> astar(const FreeSpace& space, Point start, Point goal) {
    return find_path(space, start, goal, Parents::kNeighbours);
}

}  // namespace planformer
