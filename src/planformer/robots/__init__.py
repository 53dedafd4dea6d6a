"""Robots: what moves, how large it is and how it may move."""

from planformer.robots.car import DubinsCar, ReedsSheppCar
from planformer.robots.point import PointRobot
from planformer.robots.robot import Robot

__all__ = ["DubinsCar", "PointRobot", "ReedsSheppCar", "Robot"]
