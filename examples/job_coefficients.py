"""Job a: a two-groove bearing on ISO VG 46 from 1000 to 10 000 rpm as table, picture, data frame and CSV."""

import numpy as np

import rotorfilm as rf
from rotorfilm.analysis import coefficient_table
from rotorfilm.charts import picture_of

bearing = rf.JournalBearing(
    diameter="100 mm", length="50 mm", clearance="80 um", oil=rf.Oil.iso_vg(46),
    cooling=rf.Cooling(supply_temperature="45 degC"),
    grooves=(rf.Groove(center="0 deg", width="20 deg"), rf.Groove(center="180 deg", width="20 deg")),
)  # fmt: skip
table = coefficient_table(bearing, [0.0, -5000.0], np.linspace(1000.0, 10000.0, 7) * np.pi / 30.0)
print(table)
table.to_table().to_csv("job_coefficients.csv")
picture_of(table).save("job_coefficients.png")
print("power loss at 10 000 rpm [W]", table.to_dataframe()["power_loss"].iloc[-1])
