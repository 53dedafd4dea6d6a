"""planformer as a ROS 2 node: proposes regions and plans paths for Nav2.

What a request is answered with is decided in modules that know no ROS (`error_codes`, `settings`,
`world`, `problem`, `region`, `path`); `messages`, `parameters`, `transforms`, `path_server` and
`node` connect them to rclpy.
"""
