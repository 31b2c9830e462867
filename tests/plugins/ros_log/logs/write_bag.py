"""Writes OUT.bag with Debian's python3-rosbag: python3 write_bag.py OUT.bag none|bz2|lz4."""
import sys

import genpy
import rosbag
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserEcho, LaserScan, MultiEchoLaserScan, NavSatFix
from tf2_msgs.msg import TFMessage

FIRST = 1600000000
bag = rosbag.Bag(sys.argv[1], "w", compression=sys.argv[2], chunk_threshold=2000)
mounting = TransformStamped()
mounting.header.frame_id = "base_link"
mounting.child_frame_id = "laser"
mounting.transform.translation.x = 0.2
mounting.transform.rotation.w = 1
bag.write("/tf_static", TFMessage([mounting]), genpy.Time(FIRST))
for i in range(4):
    time = genpy.Time.from_sec(FIRST + 0.25 * i)
    scan = LaserScan(angle_min=-1, angle_max=1, angle_increment=0.5, range_min=0.1, range_max=30, ranges=[2 + i] * 5)
    echoes = MultiEchoLaserScan(angle_min=-1, angle_max=1, angle_increment=1, range_min=0.1, range_max=30)
    echoes.ranges = [LaserEcho([1.5, 3.0]), LaserEcho([]), LaserEcho([2.5])]
    odometry = Odometry(child_frame_id="base_link")
    odometry.pose.pose.position.x = i
    odometry.pose.pose.orientation.w = 1
    imu = Imu()
    imu.linear_acceleration.z = 9.81
    fix = NavSatFix(latitude=48.5, longitude=9)
    for topic, message, frame in (("/scan", scan, "laser"), ("/echoes", echoes, "laser"), ("/odom", odometry, "odom"),
                                  ("/imu", imu, "base_link"), ("/fix", fix, "base_link")):
        message.header.stamp = time
        message.header.frame_id = frame
        bag.write(topic, message, time)
bag.close()
