#!/usr/bin/env bash
# Runs a command with ROS from PyPI and the generated interfaces, on the loopback device alone where
# the system allows that.
#
# usage: ros2/tools/in_ros.sh VENV INTERFACES COMMAND...
set -euo pipefail

venv=$(realpath "$1") interfaces=$(realpath "$2")
shift 2
site=$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')

export PATH=$venv/bin:$PATH
export AMENT_PREFIX_PATH=$interfaces:$venv
export LD_LIBRARY_PATH=$interfaces/lib:$venv/lib
export PYTHONPATH=$interfaces/${site#"$venv"/}
export RMW_IMPLEMENTATION=rmw_fastrtps_cpp # the wheels do not find it by themselves
export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST
export ROS_DOMAIN_ID=${ROS_DOMAIN_ID:-77}
export ROS_LOG_DIR=${ROS_LOG_DIR:-$interfaces/../log}

if unshare --map-root-user --net true 2>/dev/null && command -v ip >/dev/null; then
    exec unshare --map-root-user --net bash -c 'ip link set lo up; exec "$@"' in_ros "$@"
fi
exec "$@"
