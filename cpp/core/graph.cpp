#include "core/graph.hpp"

#include <ompl/base/PlannerData.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/informedtrees/aitstar/ImplicitGraph.h>
#include <ompl/geometric/planners/informedtrees/aitstar/Vertex.h>
#include <ompl/geometric/planners/informedtrees/bitstar/ImplicitGraph.h>
#include <ompl/geometric/planners/informedtrees/bitstar/Vertex.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/range/iterator_range.hpp>
#include <mutex>
#include <unordered_map>

#include "core/exposed.hpp"
#include "core/region.hpp"

namespace planformer {

namespace ob = ompl::base;
namespace og = ompl::geometric;

struct BitTag {
    friend constexpr auto exposed(BitTag);
};
template struct Expose<BitTag, &og::BITstar::graphPtr_>;

struct AitTag {
    friend constexpr auto exposed(AitTag);
};
template struct Expose<AitTag, &og::AITstar::graph_>;

struct RrtTag {
    friend constexpr auto exposed(RrtTag);
};
template struct Expose<RrtTag, &og::RRT::nn_>;

struct RrtStarTag {
    friend constexpr auto exposed(RrtStarTag);
};
template struct Expose<RrtStarTag, &og::RRTstar::nn_>;

struct RrtXTag {
    friend constexpr auto exposed(RrtXTag);
};
template struct Expose<RrtXTag, &og::RRTXstatic::nn_>;

namespace {

// getPlannerData of BIT*, ABIT*, AIT* and EIT* keeps every vertex that it has ever reported in a
// set that lives as long as the process (OMPL 1.5 to 1.7): memory grows with each plan and threads
// race for the set. So the graphs of the first three are read from their members.

/// What BIT* and AIT* call the same things.
struct BitGraph {
    static auto vertices(const og::BITstar& planner) {
        return (planner.*exposed(BitTag{}))->getCopyOfSamples();
    }
    template <typename Vertex>
    static const ob::State* state(const Vertex& vertex) {
        return vertex->state();
    }
    template <typename Vertex>
    static Vertex parent(const Vertex& vertex) {
        return vertex->hasParent() ? vertex->getParent() : nullptr;
    }
};

struct AitGraph {
    static auto vertices(const og::AITstar& planner) {
        return (planner.*exposed(AitTag{})).getVertices();
    }
    template <typename Vertex>
    static const ob::State* state(const Vertex& vertex) {
        return vertex->getState();
    }
    template <typename Vertex>
    static Vertex parent(const Vertex& vertex) {
        return vertex->hasForwardParent() ? vertex->getForwardParent() : nullptr;
    }
};

template <typename Graph, typename Planner>
Tree read_vertices(const Planner& planner) {
    const auto vertices = Graph::vertices(planner);
    const ob::StateSpace& space = *planner.getSpaceInformation()->getStateSpace();
    std::unordered_map<const void*, std::uint32_t> index;
    Tree tree;
    for (const auto& vertex : vertices) {
        index.emplace(vertex.get(), static_cast<std::uint32_t>(tree.vertices.size()));
        tree.vertices.push_back(read_state(space, Graph::state(vertex)));
    }
    for (const auto& vertex : vertices) {
        const auto parent = index.find(Graph::parent(vertex).get());
        if (parent != index.end()) tree.edges.emplace_back(parent->second, index[vertex.get()]);
    }
    return tree;
}

// OMPL's planner data takes milliseconds for a thousand vertices, which is too long for snapshots
// of a search. The trees of planners that go on until a limit are therefore read directly as well.

template <typename Motions>
Tree read_motions(const Motions& motions, const ob::StateSpace& space) {
    std::unordered_map<const void*, std::uint32_t> index(2 * motions.size());
    Tree tree;
    tree.vertices.reserve(motions.size());
    tree.edges.reserve(motions.size());
    for (const auto* motion : motions) {
        index.emplace(motion, static_cast<std::uint32_t>(tree.vertices.size()));
        tree.vertices.push_back(read_state(space, motion->state));
    }
    for (const auto* motion : motions) {
        const auto parent = index.find(motion->parent);
        if (parent != index.end()) tree.edges.emplace_back(parent->second, index[motion]);
    }
    return tree;
}

template <typename Motion>
std::vector<Motion> motions_of(const ompl::NearestNeighbors<Motion>& neighbours) {
    std::vector<Motion> motions;
    neighbours.list(motions);
    return motions;
}

/// Gives `use` the motions of a planner that keeps its tree in one structure of neighbours.
template <typename Use>
bool use_motions(const ob::Planner& planner, Use&& use) {
    if (const auto* star = dynamic_cast<const og::RRTstar*>(&planner)) {
        use(*(star->*exposed(RrtStarTag{})));  // Informed RRT* and SORRT* too
    } else if (const auto* x = dynamic_cast<const og::RRTXstatic*>(&planner)) {
        use(*(x->*exposed(RrtXTag{})));  // RRT# too
    } else if (const auto* rrt = dynamic_cast<const og::RRT*>(&planner)) {
        use(*(rrt->*exposed(RrtTag{})));
    } else {
        return false;
    }
    return true;
}

/// The whole roadmap, of which OMPL's planner data leaves out milestones without an edge.
Tree read_roadmap(const og::PRM& planner) {
    const og::PRM::Graph& graph = planner.getRoadmap();
    const ob::StateSpace& space = *planner.getSpaceInformation()->getStateSpace();
    Tree tree;
    for (const auto vertex : boost::make_iterator_range(boost::vertices(graph))) {
        const ob::State* state = boost::get(og::PRM::vertex_state_t(), graph, vertex);
        tree.vertices.push_back(read_state(space, state));
    }
    for (const auto edge : boost::make_iterator_range(boost::edges(graph))) {
        tree.edges.emplace_back(boost::source(edge, graph), boost::target(edge, graph));
    }
    return tree;
}

/// `getPlannerData` for all planners but those above; one at a time because of EIT*.
void copy_graph(const ob::Planner& planner, ob::PlannerData* data) {
    static std::mutex mutex;
    const std::lock_guard<std::mutex> lock(mutex);
    planner.getPlannerData(*data);
}

/// LazyPRM* holds states that it has not checked yet.
bool is_valid(const ob::Planner& planner, const ob::PlannerData& data, unsigned int vertex) {
    return planner.getSpaceInformation()->isValid(data.getVertex(vertex).getState());
}

Tree read_planner_data(const ob::Planner& planner) {
    ob::PlannerData data(planner.getSpaceInformation());
    copy_graph(planner, &data);
    const ob::StateSpace& space = *planner.getSpaceInformation()->getStateSpace();
    Tree tree;
    std::unordered_map<unsigned int, std::uint32_t> index;
    for (unsigned int i = 0; i < data.numVertices(); ++i) {
        if (!is_valid(planner, data, i)) continue;
        index.emplace(i, static_cast<std::uint32_t>(tree.vertices.size()));
        tree.vertices.push_back(read_state(space, data.getVertex(i).getState()));
    }
    std::vector<unsigned int> children;
    for (const auto& [vertex, row] : index) {
        data.getEdges(vertex, children);
        for (const unsigned int child : children) {
            const auto found = index.find(child);
            if (found != index.end()) tree.edges.emplace_back(row, found->second);
        }
    }
    return tree;
}

}  // namespace

std::size_t count_vertices(const ob::Planner& planner) {
    if (const auto* bit = dynamic_cast<const og::BITstar*>(&planner)) {
        return BitGraph::vertices(*bit).size();
    }
    if (const auto* ait = dynamic_cast<const og::AITstar*>(&planner)) {
        return AitGraph::vertices(*ait).size();
    }
    if (const auto* prm = dynamic_cast<const og::PRM*>(&planner)) return prm->milestoneCount();
    std::size_t motions = 0;
    if (use_motions(planner, [&](const auto& neighbours) { motions = neighbours.size(); })) {
        return motions;
    }
    ob::PlannerData data(planner.getSpaceInformation());
    copy_graph(planner, &data);
    std::size_t count = 0;
    for (unsigned int i = 0; i < data.numVertices(); ++i) count += is_valid(planner, data, i);
    return count;
}

Tree read_tree(const ob::Planner& planner) {
    if (const auto* bit = dynamic_cast<const og::BITstar*>(&planner)) {
        return read_vertices<BitGraph>(*bit);
    }
    if (const auto* ait = dynamic_cast<const og::AITstar*>(&planner)) {
        return read_vertices<AitGraph>(*ait);
    }
    if (const auto* prm = dynamic_cast<const og::PRM*>(&planner)) return read_roadmap(*prm);
    Tree tree;
    const bool is_read = use_motions(planner, [&](const auto& neighbours) {
        tree =
            read_motions(motions_of(neighbours), *planner.getSpaceInformation()->getStateSpace());
    });
    if (is_read) return tree;
    return read_planner_data(planner);
}

}  // namespace planformer
