#!/usr/bin/env bash
# The rosbridge client against the real rosbridge suite, by hand: no registry of packages has that.
# Usage: tests/helpers/ros2/rosbridge.sh SOURCES
# where SOURCES is a folder with check-outs of rosbridge_suite, ros2cli and rosidl_runtime_py (Jazzy).
# The environment that is active has what the tests need: pip install -e '.[test]'.
set -euo pipefail
sources=$(realpath "$1")
cd "$(dirname "$0")/../../.."
active=$(python -c 'import cbor2, pytest, sysconfig; print(sysconfig.get_path("purelib"))')
env=${ROS2_ENV:-$(mktemp -d)}  # kept from one time to the next if the variable names it
export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST ROS_DOMAIN_ID=$((RANDOM % 100))
suite=$sources/rosbridge_suite

if [ ! -e "$env/built" ]; then
    python -m venv "$env"
    packages=$("$env/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
    echo "import site; site.addsitedir('$active')" > "$packages/active.pth"
    "$env/bin/pip" install --quiet "ros-rclpy[fastrtps]==7.1.6" ros-std-msgs==5.3.6 \
        ros-sensor-msgs==5.3.6 ros-nav-msgs==5.3.6 \
        tornado pymongo pillow ujson argcomplete psutil packaging
    "$env/bin/python" tests/helpers/ros2/interfaces.py tests/helpers/ros2/*_msgs \
        "$suite/rosbridge_msgs" "$suite/rosapi_msgs"
    "$env/bin/pip" uninstall --quiet --yes lark-parser
    touch "$env/built"
fi

path=$suite/rosbridge_library/src:$suite/rosbridge_server/src:$suite/rosapi/src
for package in ros2cli ros2node ros2param ros2service ros2topic; do
    path=$path:$sources/ros2cli/$package
done
path=$path:$sources/rosidl_runtime_py
port=$((20000 + RANDOM % 10000))
PYTHONPATH=$path "$env/bin/python" "$suite/rosbridge_server/scripts/rosbridge_websocket.py" \
    --ros-args -p address:=127.0.0.1 -p port:=$port &
bridge=$!
PYTHONPATH=$path AMENT_PREFIX_PATH=$env "$env/bin/python" "$suite/rosapi/scripts/rosapi_node" &
rosapi=$!
trap 'kill -KILL $bridge $rosapi' EXIT
sleep 5
ROBOT=ws://127.0.0.1:$port "$env/bin/python" -m pytest -p no:cacheprovider -m ros2 \
    tests/executive/ros/test_ros2_robot.py
