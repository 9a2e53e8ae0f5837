"""A ROS 2 node whose head is `kbc drive`. What it takes is what `kbc drive` takes:

    python3 ros2_node.py mission.kb --scale 1 --robot robot.toml --record drive.jsonl

    hears   scan    sensor_msgs/LaserScan             metres, from the robot's centre, angle 0 ahead
            odom    nav_msgs/Odometry
            imu     sensor_msgs/Imu                   its yaw is 0 to the east of the map; without it, or if it knows no orientation, odometry counts
            line    std_msgs/Float32MultiArray        five darknesses, 0 to 1, the first at the left
            bumper  std_msgs/Bool
            tag     std_msgs/String                   "LM5 W" on a tag, "" while the reader works and reads nothing
            press   std_msgs/String                   a button: "Start1", "Abort", "Resume"
            facts   std_msgs/String                   certainties of facts, JSON: {"Fire": 0.8}; they hold until the next message, or silence
            readings std_msgs/String                  of sensors that the knowledge base declares, JSON: {"load": 12.5}
    says    cmd_vel geometry_msgs/Twist               at 50 Hz
            reports std_msgs/String                   "Help.lost", when it changes
            outputs std_msgs/String                   satellites that are outputs and high, "Call_lift, Lamp", when that changes

Each sensor has to speak twice a second at least, whatever it has to say: one that does not is left out, and the robot stands where it needs it.
The base has to stop by itself when it has heard no cmd_vel for 0.2 s.
"""
import json
import sys
import time

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Bool, Float32MultiArray, String

from bridge import STAND, Mind, MindGone, eight_ranges, yaw

PERIOD_S = 0.02
SILENT_AFTER_S = 0.5     # a sensor
PRESSED_S = 0.3          # a button


def yaw_of(orientation):
    return yaw(orientation.x, orientation.y, orientation.z, orientation.w)


def of_scan(scan):
    return {"range_m": eight_ranges(scan.ranges, scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max)}


def of_odometry(odometry):
    pose = odometry.pose.pose
    return {"odometry_x_m": pose.position.x, "odometry_y_m": pose.position.y, "odometry_m_s": odometry.twist.twist.linear.x,
            "odometry_turned_rad": yaw_of(pose.orientation)}


def of_imu(imu):
    """Nothing of an IMU that has gyroscopes and no orientation, which it says by its covariance."""
    return {} if imu.orientation_covariance[0] == -1 else {"compass_rad": yaw_of(imu.orientation)}


def of_tag(tag):
    words = tag.data.split()
    return {"tag": {"landmark": words[0], "exit": words[1]} if len(words) == 2 else {}}


def of_facts(facts):
    return {"facts": named_values(facts)}


def named_values(text):
    """Of a message, which may be anything: ValueError unless it is a JSON object."""
    values = json.loads(text.data)
    if not isinstance(values, dict):
        raise ValueError("not a JSON object")
    return values


SENSORS = (
    (LaserScan, "scan", of_scan),
    (Odometry, "odom", of_odometry),
    (Imu, "imu", of_imu),
    (Float32MultiArray, "line", lambda line: {"line": list(line.data)}),
    (Bool, "bumper", lambda bumper: {"touched": bumper.data}),
    (String, "tag", of_tag),
    (String, "facts", of_facts),
)
SAID = ("reports", "outputs")   # as a text, when it changes


class Head(Node):
    def __init__(self, *arguments):
        super().__init__("kbc_drive")
        self.mind = Mind(*arguments)
        self.heard = {}        # topic: when, and the fields that it fills
        self.pressed = {}      # button: when
        self.readings = {}     # since the last line: each counts until it is replaced or stale, so it is said once
        self.told = {topic: [] for topic in SAID}
        for kind, topic, fields_of in SENSORS:
            self.create_subscription(kind, topic, self.hear(topic, fields_of), qos_profile_sensor_data)
        self.create_subscription(String, "press", lambda press: self.pressed.update({press.data: time.monotonic()}), 10)
        self.create_subscription(String, "readings", self.take_readings, qos_profile_sensor_data)
        self.wheels = self.create_publisher(Twist, "cmd_vel", 1)
        self.publishers_of = {topic: self.create_publisher(String, topic, 10) for topic in SAID}
        self.timer = self.create_timer(PERIOD_S, self.step)

    def hear(self, topic, fields_of):
        def take(message):
            try:
                self.heard[topic] = (time.monotonic(), fields_of(message))
            except ValueError as wrong:
                self.complain(f"{topic}: {wrong}")
        return take

    def take_readings(self, message):
        try:
            self.readings.update(named_values(message))
        except ValueError as wrong:
            self.complain(f"readings: {wrong}")

    def complain(self, text):
        self.get_logger().error(text, throttle_duration_sec=1.0)

    def senses(self, now):
        """Of a clock that is never set back, and without what is old."""
        senses = {"t": now}
        for when, fields in self.heard.values():
            if now - when < SILENT_AFTER_S:
                senses.update(fields)
        senses["readings"], self.readings = self.readings, {}
        senses["buttons"] = [button for button, when in self.pressed.items() if now - when < PRESSED_S]
        return senses

    def step(self):
        answer = self.mind.step(self.senses(time.monotonic())) or STAND
        if "error" in answer:
            self.complain(answer["error"]["message"])
        for topic, before in self.told.items():
            if answer.get(topic, before) != before:
                self.told[topic] = answer[topic]
                self.publishers_of[topic].publish(String(data=", ".join(answer[topic])))
        self.drive(answer)

    def drive(self, answer):
        twist = Twist()
        twist.linear.x, twist.angular.z = float(answer["speed"]), float(answer["turn"])
        self.wheels.publish(twist)


def main():
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)     # so that it can still say that the wheels stand
    head = Head(*sys.argv[1:])
    try:
        rclpy.spin(head)
    except KeyboardInterrupt:
        pass
    except MindGone:
        head.get_logger().fatal("kbc drive does not answer: the robot stands")
    head.drive(STAND)
    code = head.mind.close()
    rclpy.shutdown()
    return code


if __name__ == "__main__":
    sys.exit(main())
