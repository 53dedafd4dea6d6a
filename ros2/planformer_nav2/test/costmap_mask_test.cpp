#include "planformer_nav2/costmap_mask.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace planformer_nav2 {
namespace {

using Cells = std::vector<unsigned char>;
using Inside = std::vector<std::uint8_t>;
using Random = std::mt19937;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

unsigned int up_to(Random& random, unsigned int most) {
    return std::uniform_int_distribution<unsigned int>(0, most)(random);
}

Grid unit_grid(unsigned int width, unsigned int height) { return {width, height, 1.0, 0.0, 0.0}; }

/// What a costmap looks like under a mask.
Cells masked(Cells cells, const Grid& grid, const Inside& inside,
             const std::vector<Disc>& kept = {}, UnknownOutside unknown = UnknownOutside::kClose) {
    const CostmapMask mask({cells.data(), grid}, inside, kept, unknown);
    return Cells(cells);
}

/// A map of any shape with costs of all kinds, a region, and discs that may lie outside.
struct Scene {
    explicit Scene(Random& random) {
        grid = {up_to(random, 12), up_to(random, 12), uniform(random, 0.01, 2.0),
                uniform(random, -50.0, 50.0), uniform(random, -50.0, 50.0)};
        for (std::size_t i = 0; i < grid.cell_count(); ++i) {
            const auto cost = static_cast<unsigned char>(up_to(random, 255));
            const bool special = up_to(random, 2) == 0;
            cells.push_back(special ? static_cast<unsigned char>(253 + cost % 3) : cost);
            inside.push_back(static_cast<std::uint8_t>(up_to(random, 2)));
        }
        for (unsigned int count = up_to(random, 2); count > 0; --count) {
            kept.push_back({grid.origin_x + grid.resolution * uniform(random, -5.0, 17.0),
                            grid.origin_y + grid.resolution * uniform(random, -5.0, 17.0),
                            grid.resolution * uniform(random, 0.0, 4.0)});
        }
        unknown = up_to(random, 1) == 0 ? UnknownOutside::kClose : UnknownOutside::kKeep;
    }

    Grid grid;
    Cells cells;
    Inside inside;
    std::vector<Disc> kept;
    UnknownOutside unknown = UnknownOutside::kClose;
};

TEST(CostmapMask, ClosesOutsideAndKeepsInside) {
    const Cells cells = {0, 128, 252, 253, 254, 255, 0, 128, 252, 253, 254, 255};
    const Inside inside = {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0};
    const Cells expected = {0, 128, 252, 253, 254, 255, 253, 253, 253, 253, 254, 253};
    EXPECT_EQ(masked(cells, unit_grid(6, 2), inside), expected);
}

TEST(CostmapMask, KeepsUnknownOutsideForPlannersThatNeverEnterIt) {
    const Cells cells = {255, 255, 0, 254};
    const Cells expected = {255, 255, 253, 254};
    EXPECT_EQ(masked(cells, unit_grid(4, 1), {1, 0, 0, 0}, {}, UnknownOutside::kKeep), expected);
}

TEST(CostmapMask, TakesAnyValueButZeroForInside) {
    EXPECT_EQ(masked({1, 2, 3}, unit_grid(3, 1), {255, 2, 0}), (Cells{1, 2, 253}));
}

TEST(CostmapMask, RestoresAtTheEndOfItsLife) {
    const Cells before = {0, 1, 2, 3, 254, 255};
    Cells cells = before;
    {
        const CostmapMask mask({cells.data(), unit_grid(3, 2)}, Inside(6, 0), {},
                               UnknownOutside::kClose);
        EXPECT_NE(cells, before);
    }
    EXPECT_EQ(cells, before);
}

TEST(CostmapMask, RestoresOnAnException) {
    const Cells before = {7, 8, 9, 255};
    Cells cells = before;
    const auto plan = [&cells] {
        const CostmapMask mask({cells.data(), unit_grid(2, 2)}, Inside(4, 0), {},
                               UnknownOutside::kClose);
        throw std::runtime_error("no path");
    };
    EXPECT_THROW(plan(), std::runtime_error);
    EXPECT_EQ(cells, before);
}

TEST(CostmapMask, RestoresOnAnEarlyReturn) {
    const Cells before = {7, 8, 9, 255};
    Cells cells = before;
    const auto plan = [&cells](bool at_once) {
        const CostmapMask mask({cells.data(), unit_grid(2, 2)}, Inside(4, 0), {},
                               UnknownOutside::kClose);
        if (at_once) return 1;
        return 2;
    };
    EXPECT_EQ(plan(true), 1);
    EXPECT_EQ(cells, before);
}

// NavFn, for one, frees the cell of the start.
TEST(CostmapMask, RestoresWhatAPlannerWroteMeanwhile) {
    const Cells before = {7, 8, 9, 255};
    Cells cells = before;
    {
        const CostmapMask mask({cells.data(), unit_grid(2, 2)}, {1, 1, 0, 0}, {},
                               UnknownOutside::kClose);
        std::fill(cells.begin(), cells.end(), static_cast<unsigned char>(100));
    }
    EXPECT_EQ(cells, before);
}

TEST(CostmapMask, RefusesARegionOfAnotherSize) {
    const Cells before = {1, 2, 3, 4, 5, 6};
    Cells cells = before;
    for (const std::size_t count : {0, 5, 7}) {
        EXPECT_THROW(CostmapMask({cells.data(), unit_grid(3, 2)}, Inside(count, 0), {},
                                 UnknownOutside::kClose),
                     std::invalid_argument);
        EXPECT_EQ(cells, before);
    }
}

TEST(CostmapMask, SaysWhichSizesDiffer) {
    Cells cells = {1, 2, 3, 4, 5, 6};
    try {
        const CostmapMask mask({cells.data(), unit_grid(3, 2)}, Inside(5, 0), {},
                               UnknownOutside::kClose);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "the region has 5 cells, the costmap has 3 x 2");
    }
}

// Their product does not fit 32 bits: it would be 0, which is the size of an empty region.
TEST(CostmapMask, CountsTheCellsOfHugeMaps) {
    EXPECT_EQ(unit_grid(65536, 65536).cell_count(), std::size_t{1} << 32);
    EXPECT_THROW(CostmapMask({nullptr, unit_grid(65536, 65536)}, {}, {}, UnknownOutside::kClose),
                 std::invalid_argument);
}

TEST(CostmapMask, TakesAnEmptyMap) {
    EXPECT_EQ(masked({}, Grid{}, {}, {{0.0, 0.0, 1.0}}), Cells{});
    EXPECT_EQ(masked({}, unit_grid(5, 0), {}, {{0.0, 0.0, 1.0}}), Cells{});
    const CostmapMask mask({nullptr, Grid{}}, {}, {}, UnknownOutside::kClose);
}

TEST(CostmapMask, KeepsADiscAsItWas) {
    const Cells cells(25, 7);
    Cells expected(25, 253);
    for (const std::size_t cell : {7, 11, 12, 13, 17}) expected[cell] = 7;
    EXPECT_EQ(masked(cells, unit_grid(5, 5), Inside(25, 0), {{2.5, 2.5, 1.2}}), expected);
}

TEST(CostmapMask, KeepsWhatIsClosedInADiscClosed) {
    const Cells cells = {253, 254, 255};
    EXPECT_EQ(masked(cells, unit_grid(3, 1), Inside(3, 0), {{1.5, 0.5, 9.0}}), cells);
}

TEST(CostmapMask, KeepsTheCellOfADiscWithoutRadius) {
    const Grid grid = {3, 2, 0.1, -0.3, 5.0};
    EXPECT_EQ(masked(Cells(6, 9), grid, Inside(6, 0), {{-0.15, 5.15, 0.0}}),
              (Cells{253, 253, 253, 253, 9, 253}));
}

TEST(CostmapMask, CutsDiscsOffAtTheBorder) {
    const Cells cells(9, 7);
    const Grid grid = unit_grid(3, 3);
    EXPECT_EQ(masked(cells, grid, Inside(9, 0), {{0.0, 0.0, 1.0}}),
              (Cells{7, 253, 253, 253, 253, 253, 253, 253, 253}));
    EXPECT_EQ(masked(cells, grid, Inside(9, 0), {{2.9, 2.9, 1.5}}),
              (Cells{253, 253, 253, 253, 253, 7, 253, 7, 7}));
    EXPECT_EQ(masked(cells, grid, Inside(9, 0), {{-1.0, 1.5, 1.5}}),
              (Cells{253, 253, 253, 7, 253, 253, 253, 253, 253}));
}

TEST(CostmapMask, TakesNoNoticeOfDiscsFarAway) {
    const Grid grid = unit_grid(3, 3);
    const Cells closed(9, 253);
    const std::vector<double> places = {-1e300, -10.0, 10.0, 1e300, kInfinity, kNoNumber};
    for (const double x : places) {
        for (const double y : places) {
            EXPECT_EQ(masked(Cells(9, 7), grid, Inside(9, 0), {{x, y, 0.5}}), closed);
        }
    }
}

TEST(CostmapMask, KeepsTheWholeMapInAHugeDisc) {
    for (const double radius : {100.0, 1e300, kInfinity}) {
        EXPECT_EQ(masked(Cells(9, 7), unit_grid(3, 3), Inside(9, 0), {{1.0, 1.0, radius}}),
                  Cells(9, 7));
    }
}

TEST(CostmapMaskProperty, RestoresEveryByte) {
    Random random(1);
    for (int trial = 0; trial < 3000; ++trial) {
        const Scene scene(random);
        Cells cells = scene.cells;
        try {
            const CostmapMask mask({cells.data(), scene.grid}, scene.inside, scene.kept,
                                   scene.unknown);
            for (unsigned char& cost : cells) cost = static_cast<unsigned char>(up_to(random, 255));
            if (up_to(random, 1) == 0) throw std::runtime_error("no path");
        } catch (const std::runtime_error&) {}
        ASSERT_EQ(cells, scene.cells);
    }
}

/// Whether a disc keeps the cell, decided in metres; `slack` [m] makes the disc larger.
bool keeps(const Disc& disc, const Grid& grid, std::size_t cell, double slack) {
    const double half = 0.5 * grid.resolution;
    const double x =
        grid.origin_x + static_cast<double>(cell % grid.width) * grid.resolution + half;
    const double y =
        grid.origin_y + static_cast<double>(cell / grid.width) * grid.resolution + half;
    const double dx = std::abs(disc.x - x);
    const double dy = std::abs(disc.y - y);
    return std::hypot(dx, dy) <= disc.radius + slack || std::max(dx, dy) <= half + slack;
}

bool is_kept(const Scene& scene, std::size_t cell, double slack) {
    return std::any_of(scene.kept.begin(), scene.kept.end(),
                       [&](const Disc& disc) { return keeps(disc, scene.grid, cell, slack); });
}

unsigned char closed(unsigned char cost, UnknownOutside unknown) {
    if (cost == kLethal) return kLethal;
    if (cost == kUnknown && unknown == UnknownOutside::kKeep) return kUnknown;
    return kInscribed;
}

TEST(CostmapMaskProperty, EveryCellIsKeptOrClosed) {
    Random random(2);
    for (int trial = 0; trial < 3000; ++trial) {
        const Scene scene(random);
        const Cells result =
            masked(scene.cells, scene.grid, scene.inside, scene.kept, scene.unknown);
        for (std::size_t cell = 0; cell < result.size(); ++cell) {
            const unsigned char before = scene.cells[cell];
            // Cells that a disc just keeps, or just does not, may go either way.
            const bool surely = scene.inside[cell] != 0 || is_kept(scene, cell, -1e-9);
            const bool perhaps = scene.inside[cell] != 0 || is_kept(scene, cell, 1e-9);
            if (surely) {
                ASSERT_EQ(result[cell], before);
            }
            if (!perhaps) {
                ASSERT_EQ(result[cell], closed(before, scene.unknown));
            }
        }
    }
}

TEST(CostmapMaskProperty, NeverOpensACell) {
    Random random(3);
    const auto is_blocked = [](unsigned char cost) { return cost == 253 || cost == 254; };
    for (int trial = 0; trial < 3000; ++trial) {
        const Scene scene(random);
        const Cells result =
            masked(scene.cells, scene.grid, scene.inside, scene.kept, scene.unknown);
        for (std::size_t cell = 0; cell < result.size(); ++cell) {
            if (is_blocked(scene.cells[cell])) {
                ASSERT_TRUE(is_blocked(result[cell]));
            }
            ASSERT_EQ(result[cell] == kLethal, scene.cells[cell] == kLethal);
        }
    }
}

TEST(Grid, DiffersInEachOfItsNumbers) {
    const Grid grid = {3, 2, 0.05, 1.0, -1.0};
    EXPECT_EQ(grid, (Grid{3, 2, 0.05, 1.0, -1.0}));
    EXPECT_NE(grid, (Grid{2, 2, 0.05, 1.0, -1.0}));
    EXPECT_NE(grid, (Grid{3, 3, 0.05, 1.0, -1.0}));
    EXPECT_NE(grid, (Grid{3, 2, 0.06, 1.0, -1.0}));
    EXPECT_NE(grid, (Grid{3, 2, 0.05, 1.05, -1.0}));
    EXPECT_NE(grid, (Grid{3, 2, 0.05, 1.0, -1.05}));
}

}  // namespace
}  // namespace planformer_nav2
