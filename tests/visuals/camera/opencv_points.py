"""Projects points by OpenCV: reads lines "model fx fy cx cy k..., x y z" and writes "column row" for each."""
import sys

import cv2
import numpy as np

for line in sys.stdin:
    camera, point = line.split(",")
    model, *numbers = camera.split()
    fx, fy, cx, cy, *k = map(float, numbers)
    matrix = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    points = np.array(point.split(), dtype=float).reshape(1, 1, 3)
    zero = np.zeros(3)
    if model == "fisheye":
        pixel, _ = cv2.fisheye.projectPoints(points, zero, zero, matrix, np.array(k[:4]))
    else:
        pixel, _ = cv2.projectPoints(points, zero, zero, matrix, np.array(k[:5]))
    print("%.17g %.17g" % tuple(pixel.reshape(2)))
