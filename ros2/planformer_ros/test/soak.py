"""Sends goals at a fixed rate while the map changes, and counts the deadlines that are kept.

From the repository's root, after `make test-ros`:

ros2/tools/in_ros.sh .venv-ros build/ros/install \
    python ros2/planformer_ros/test/soak.py --output benchmarks/results/ros2/soak.json
"""

from __future__ import annotations

import argparse
import json
import os
import tempfile
import threading
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import planformer as pf
import rclpy
from planformer.bench.environment import environment
from planformer.files import write_files
from planformer.maps import Costmap
from planformer.maps.costmap import inflated, with_patch

from client import PATIENCE, SUCCEEDED, Client, Planner, make_goal, poses_of, until
from planformer_ros.error_codes import ErrorCode

RADIUS = 0.2
OBSTACLE = 12
"""Side in cells of what comes and goes."""
GOALS_PER_CHANGE = 5


@dataclass
class Goal:
    """A goal and what became of it.

    Attributes:
        sent: When it was sent [s].
        answered: When its result arrived, infinite for never.
        status: How the action ended.
        code: The result's error code.
        path: (N, 2) points, empty without a path.
        maps: The costmaps that were the newest one from sending to answering.
        done: Set when the answer is there.
    """

    sent: float
    maps: list[Costmap]
    answered: float = float("inf")
    status: int = 0
    code: int = 0
    path: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))
    done: threading.Event = field(default_factory=threading.Event)


@dataclass(frozen=True)
class Report:
    """What came of all goals.

    Attributes:
        goals: All but those of the warm-up.
        period: Time from a goal to the next in seconds, which is the deadline too.
        memory_before: Resident memory of the planner in MB after the warm-up.
        memory_after: The same at the end.
        settings: Those of the planner that are not its defaults.
    """

    goals: list[Goal]
    period: float
    memory_before: float
    memory_after: float
    settings: dict[str, object]

    @property
    def in_time(self) -> list[Goal]:
        """Goals whose path arrived before the next goal was due."""
        return [
            goal
            for goal in self.goals
            if goal.status == SUCCEEDED and goal.answered - goal.sent <= self.period
        ]

    @property
    def blocked(self) -> list[Goal]:
        """Goals whose path is blocked on every map of its time; there should be none."""
        robot = pf.PointRobot(0.0)
        return [
            goal
            for goal in self.goals
            if len(goal.path)
            and not any(pf.path_is_valid(world.grid, robot, goal.path) for world in goal.maps)
        ]

    def summary(self) -> dict[str, object]:
        """The report as JSON-compatible values."""
        delays = [1e3 * (goal.answered - goal.sent) for goal in self.goals if goal.done.is_set()]
        return {
            "goals": len(self.goals),
            "rate_hz": 1.0 / self.period,
            "deadline_ms": 1e3 * self.period,
            "settings": self.settings,
            "deadlines_kept": len(self.in_time) / len(self.goals),
            "answer_ms": {
                f"p{share}": round(float(np.percentile(delays, share)), 1)
                for share in (50, 90, 99, 100)
            },
            "error_codes": dict(Counter(ErrorCode(goal.code).name for goal in self.goals)),
            "never_answered": sum(not goal.done.is_set() for goal in self.goals),
            "blocked_paths": len(self.blocked),
            "memory_mb": {"before": self.memory_before, "after": self.memory_after},
        }


class Soak:
    """A client that does not wait for an answer before it sends the next goal."""

    def __init__(self, client: Client, seed: int) -> None:
        self._client, self._random = client, np.random.default_rng(seed)
        self._base = inflated(Costmap.from_grid(pf.generate_indoor(seed=seed)), RADIUS)
        self._world, self._lock = self._base, threading.Lock()
        self._under_way: set[int] = set()
        self._goals: list[Goal] = []
        free = pf.PointRobot(0.3)
        self._places = np.argwhere(~self._base.grid.blocked(free.radius))
        client.publish_costmap(self._base)
        until(lambda: self._reaches_somewhere())

    def _reaches_somewhere(self) -> bool:
        """The planner has the map once it finds a way on it."""
        start, goal = self._pair()
        return self._client.plan(start, goal)[0] == SUCCEEDED

    def _pair(self) -> tuple[np.ndarray, np.ndarray]:
        """A start and a goal that the map without obstacles connects."""
        while True:
            cells = self._places[self._random.integers(len(self._places), size=2)]
            start, goal = self._base.grid.to_xy(cells)
            grid, robot = self._base.grid, pf.PointRobot(0.0)
            if pf.planning.is_connected(grid.free, pf.Problem(grid, robot, start, goal)):
                return start, goal

    def change_map(self) -> None:
        """Take away the obstacle that is there and put up another one."""
        rows, columns = self._base.costs.shape
        row = int(self._random.integers(rows - OBSTACLE))
        column = int(self._random.integers(columns - OBSTACLE))
        wall = np.full((OBSTACLE, OBSTACLE), 254, np.uint8)
        with self._lock:
            self._world = with_patch(self._base, wall, column, row)
            for index in self._under_way:
                self._goals[index].maps.append(self._world)
        self._client.publish_costmap(self._world)

    def send(self) -> None:
        """Send a goal and note its answer when it comes."""
        start, goal = self._pair()
        with self._lock:
            index = len(self._goals)
            noted = Goal(time.perf_counter(), [self._world])
            # The planner may still have the map of before when the goal arrives.
            noted.maps += self._goals[-1].maps[:1] if self._goals else []
            self._goals.append(noted)
            self._under_way.add(index)
        accepted = self._client.send_later(make_goal(start, goal))

        def note(future) -> None:
            answer = future.result()
            noted.answered = time.perf_counter()
            noted.status, noted.code = answer.status, answer.result.error_code
            noted.path = poses_of(answer.result.path)[:, :2]
            with self._lock:
                self._under_way.discard(index)
            noted.done.set()

        def ask(future) -> None:
            future.result().get_result_async().add_done_callback(note)

        accepted.add_done_callback(ask)

    def run(self, count: int, period: float) -> list[Goal]:
        """Send goals at a fixed rate and wait for what is under way in the end."""
        first = len(self._goals)
        started = time.perf_counter()
        for number in range(count):
            if number % GOALS_PER_CHANGE == 0:
                self.change_map()
            self.send()
            time.sleep(max(0.0, started + (number + 1) * period - time.perf_counter()))
        goals = self._goals[first:]
        for goal in goals:
            goal.done.wait(PATIENCE)
        return goals


def soak(
    folder: Path, *, goals: int, rate: float, time_limit: float, warm_up: int, seed: int = 0
) -> Report:
    """Run a planner of its own and send it goals.

    Args:
        folder: For the planner's log.
        goals: How many, after those to warm up.
        rate: Goals a second.
        time_limit: The planner's, in seconds.
        warm_up: Goals before the memory is looked at. ROS keeps each result for ten seconds.
        seed: Seed of the map, its changes and the goals.
    """
    settings = {"time_limit": time_limit, "guided_share": 0.6}
    with Planner(folder, autostart=True, **settings) as planner, Client() as client:
        run = Soak(client, seed)
        run.run(warm_up, 1.0 / rate)
        before = memory_mb(planner.process.pid)
        answered = run.run(goals, 1.0 / rate)
        after = memory_mb(planner.process.pid)
    return Report(answered, 1.0 / rate, before, after, settings)


def memory_mb(pid: int) -> float:
    """Resident memory of a process."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    kilobytes = next(line.split()[1] for line in lines if line.startswith("VmRSS"))
    return round(int(kilobytes) / 1024, 1)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--goals", type=int, default=1000)
    parser.add_argument("--rate", type=float, default=10.0, help="goals a second")
    parser.add_argument("--time-limit", type=float, default=0.06, help="of the planner [s]")
    parser.add_argument("--warm-up", type=int, default=150, help="goals before those")
    parser.add_argument("--output", type=Path, help="JSON file")
    options = parser.parse_args()
    if options.output is not None:
        options.output.parent.mkdir(parents=True, exist_ok=True)
    busy = {"load_before": os.getloadavg()[0], "nice": os.nice(0)}
    rclpy.init()
    with tempfile.TemporaryDirectory() as folder:
        report = soak(
            Path(folder),
            goals=options.goals,
            rate=options.rate,
            time_limit=options.time_limit,
            warm_up=options.warm_up,
        )
    rclpy.try_shutdown()
    busy["load_after"] = os.getloadavg()[0]
    result = {"environment": environment(), "machine_busy": busy, **report.summary()}
    text = json.dumps(result, indent=2) + "\n"
    print(text, end="")
    if options.output is not None:
        write_files({options.output: text.encode()})


if __name__ == "__main__":
    main()
