"""Job h: stiffness of the bearings of a spindle over preload and speed, as a table and a map."""

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import plot_map

row = rf.BallBearing(balls=16, ball_diameter="7.938 mm", pitch_diameter="46.5 mm", contact_angle="25 deg")
preloads, speeds = np.linspace(50.0, 400.0, 5), np.linspace(1000.0, 20000.0, 5)
table = []
for speed in speeds * np.pi / 30.0:
    pairs = [rf.back_to_back(row, distance="20 mm", preload=preload) for preload in preloads]
    table.append([1e-6 * rf.coefficients(pair, [0.0, 0.0], speed).stiffness[0, 0] for pair in pairs])
print(np.array2string(np.array(table), precision=1))
labels = "preload [N]", "speed [rpm]", "stiffness [N/um]"
plot_map(preloads, speeds, table, labels=labels).save("job_spindle.png")
print("softest / stiffest:", np.min(table) / np.max(table))
