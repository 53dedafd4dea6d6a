"""Starts planformer's node.

ros2 launch planformer_ros planformer.launch.py params_file:=my.yaml
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import LifecycleNode
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    """The arguments and the node."""
    defaults = PathJoinSubstitution(
        [FindPackageShare("planformer_ros"), "config", "planformer.yaml"]
    )
    arguments = [
        DeclareLaunchArgument("params_file", default_value=defaults, description="parameters"),
        DeclareLaunchArgument("namespace", default_value="", description="namespace"),
        DeclareLaunchArgument("use_sim_time", default_value="false", description="clock of Gazebo"),
        DeclareLaunchArgument("respawn", default_value="true", description="start it anew"),
        DeclareLaunchArgument("log_level", default_value="info", description="least to log"),
    ]
    node = LifecycleNode(
        package="planformer_ros",
        executable="planner",
        name="planformer",
        namespace=LaunchConfiguration("namespace"),
        parameters=[
            LaunchConfiguration("params_file"),
            {"use_sim_time": LaunchConfiguration("use_sim_time")},
        ],
        arguments=["--ros-args", "--log-level", LaunchConfiguration("log_level")],
        remappings=[("/tf", "tf"), ("/tf_static", "tf_static")],  # as in Nav2's launch files
        output="screen",
        respawn=LaunchConfiguration("respawn"),
        respawn_delay=2.0,
    )
    return LaunchDescription([*arguments, node])
