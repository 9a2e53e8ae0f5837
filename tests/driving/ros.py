#!/usr/bin/env python3
"""The ROS 2 node of example 9, with stand-ins for the modules of ROS, which is not there: topics are dictionaries, and time is what the test says.

  ros.py EXAMPLE
"""
import math
import os
import sys
import tempfile
import types

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])


class Message(types.SimpleNamespace):
    """Any message: a member that nobody has set is one again."""

    def __getattr__(self, name):
        setattr(self, name, Message())
        return getattr(self, name)


class Node:
    def __init__(self, name):
        self.topics, self.said, self.logged = {}, {}, []

    def create_subscription(self, kind, topic, callback, qos):
        self.topics[topic] = callback

    def create_publisher(self, kind, topic, qos):
        said = self.said.setdefault(topic, [])
        return types.SimpleNamespace(publish=said.append)

    def create_timer(self, period_s, callback):
        assert period_s == 0.02

    def get_logger(self):
        return types.SimpleNamespace(error=lambda text, throttle_duration_sec: self.logged.append(text))


def module(name, **members):
    sys.modules[name] = types.ModuleType(name)
    sys.modules[name].__dict__.update(members)


module('rclpy')
module('rclpy.node', Node=Node)
module('rclpy.qos', qos_profile_sensor_data=None)
module('rclpy.signals', SignalHandlerOptions=None)
for package, kinds in {'geometry_msgs': ['Twist'], 'nav_msgs': ['Odometry'], 'sensor_msgs': ['Imu', 'LaserScan'], 'std_msgs': ['Bool', 'Float32MultiArray', 'String']}.items():
    module(package)
    module(package + '.msg', **dict.fromkeys(kinds, Message))

import bridge, ros2_node  # noqa: E402, E401  (its modules stand in above)

now = 100.0
bridge.LONGEST_WAIT_S = 60.0   # the machine may be busy
ros2_node.time = types.SimpleNamespace(monotonic=lambda: now)


def quaternion(yaw_rad):
    return Message(x=0.0, y=0.0, z=math.sin(yaw_rad / 2), w=math.cos(yaw_rad / 2))


def drive(head, seconds, silent=(), **more):
    """What the robot's drivers say, `more` among it, and the node's timer. The last command of the wheels."""
    global now
    odometry = Message()
    odometry.pose.pose = Message(position=Message(x=0.0, y=0.0), orientation=quaternion(0.0))
    odometry.twist.twist.linear.x = 0.0
    said = {'scan': Message(ranges=[math.inf] * 360, angle_min=-math.pi, angle_increment=math.pi / 180, range_min=0.1, range_max=12.0), 'odom': odometry,
            'imu': Message(orientation=quaternion(0.0), orientation_covariance=[0.0] * 9),
            'line': Message(data=[0.1, 0.1, 0.9, 0.1, 0.1]), 'bumper': Message(data=False), 'tag': Message(data='')}
    said |= {topic: Message(data=text) for topic, text in more.items()}
    for _ in range(round(seconds / 0.02)):
        now += 0.02
        for topic, message in said.items():
            if topic not in silent:
                head.topics[topic](message)
        head.step()
    return head.said['cmd_vel'][-1]


lift = os.path.join(tempfile.mkdtemp(), 'lift.kb')   # the track for a robot with a scale
with open(sys.argv[1] + '/track.kb', encoding='utf-8') as track, open(lift, 'w', encoding='utf-8') as written:
    written.write(track.read() + """
sensor load 0..50 noise 0.5 stale 60 s
fact Heavy = load ~ ramp(5, 10)
fact Fire
satellite Lamp, Alarm output
rule shine at control while seen Heavy then +Lamp
rule alarm at control while seen Fire then +Alarm
rule fade at control while not seen Heavy and Lamp then -Lamp
rule calm at control while not seen Fire and Alarm then -Alarm
""")
head = ros2_node.Head(lift)
assert drive(head, 1.0).linear.x == 0.0, 'nobody has pressed anything'
head.topics['press'](Message(data='Go'))
wheels = drive(head, 1.0)
assert wheels.linear.x > 0.1 and abs(wheels.angular.z) < 0.1, wheels
assert drive(head, 0.4, silent=['line']).linear.x > 0.1, 'a sensor may miss a message'
assert drive(head, 1.0, silent=['line']).linear.x == 0.0 and head.said['reports'][-1].data == 'Help.no_line', head.said['reports']
assert drive(head, 1.0, silent=['scan']).linear.x == 0.0 and 'Help.no_ranges' in head.said['reports'][-1].data, head.said['reports']
head.topics['readings'](Message(data='{"load": 30}'))
drive(head, 1.0, facts='{"Fire": 0.9}')
assert set(head.said['outputs'][-1].data.split(', ')) == {'Lamp', 'Alarm'}, head.said['outputs']
drive(head, 0.7)
assert head.said['outputs'][-1].data == 'Lamp', 'a fact is over with its topic, a reading is not'
head.topics['readings'](Message(data='{"load": 0}'))
drive(head, 0.2)
assert head.said['outputs'][-1].data == '', head.said['outputs']
assert not head.logged, head.logged
drive(head, 0.1, facts='[0.9]', readings='{"load"')
assert [text.split(':')[0] for text in head.logged[-2:]] == ['facts', 'readings'], head.logged
head.topics['press'](Message(data='Gо'))   # with a letter that only looks like the o
drive(head, 0.1)
assert head.logged and head.said['cmd_vel'][-1].linear.x == 0.0
assert head.mind.close() == 1

ahead = bridge.eight_ranges([0.0, 0.0, 2.0, 0.0, 13.0], -0.2, 0.1, 0.1, 12.0)
assert ahead == [2.0] + [None] * 7, f'a ray that did not come back is no wall, and no free way: {ahead}'
assert bridge.eight_ranges([math.inf, 50.0, -math.inf], -0.1, 0.1, 0.1, 60.0)[0] == 0.1, 'something is too near to be measured'
assert bridge.eight_ranges([math.inf], 0.0, 0.1, 0.1, 60.0)[0] >= 4 * 20, 'nothing is there for a large robot either'
assert ros2_node.of_imu(Message(orientation=quaternion(1.0), orientation_covariance=[-1.0] + [0.0] * 8)) == {}, 'an IMU without orientation'
nothing = Message(x=0.0, y=0.0, z=0.0, w=0.0)
assert ros2_node.of_imu(Message(orientation=nothing, orientation_covariance=[0.0] * 9)) == {'compass_rad': None}, 'four zeros are no compass that looks east'
print('the node drives, stands where a sensor is silent, and says why')
