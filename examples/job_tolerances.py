"""Job g: five hundred bearings within their tolerances: histogram, tornado chart and a table."""

import rotorfilm as rf
from rotorfilm.charts import picture_of
from rotorfilm.sweeps import scatter_study

film = {"radius": 0.05, "length": 0.05}


def minimum_film(clearance: float, viscosity: float) -> float:
    """Return the smallest film of a bearing [m]."""
    bearing = rf.JournalBearing(**film, clearance=clearance, viscosity=viscosity)
    return rf.equilibrium(bearing, [0.0, -5000.0], 314.0).minimum_film


nominal, tolerances = {"clearance": 8e-5, "viscosity": 0.02}, {"clearance": 1e-5, "viscosity": 2e-3}
study = scatter_study(minimum_film, nominal, tolerances, quantity="minimum film", unit="m", samples=500)
print(study)
picture_of(study).save("job_tolerances_histogram.png")
picture_of(study, "tornado").save("job_tolerances_tornado.png")
print("scatter of the film [um]:", 1e6 * study.deviation)
