"""The main bearing of a large turbine: its film is turbulent, and takes 1.8 times the power of a laminar one.

The last number is the temperature of the film [degC] by the fit of Ng & Pan; an independent code has 63.0.
"""

import rotorfilm as rf

oil = rf.Oil.two_points((313.15, 32e-6), (373.15, 5.36e-6))
cooled = {"oil": oil, "cooling": rf.Cooling(supply_temperature="45 degC")}
size = {"diameter": "500 mm", "length": "400 mm", "clearance": "0.5 mm"}
turbulence = rf.bearings.Turbulence(closure="ng_pan", band=False)
bearing = rf.JournalBearing(**size, **cooled, turbulence=turbulence)
at = rf.equilibrium(bearing, load=[0.0, "-300 kN"], speed="3000 rpm")
film = rf.coefficients(bearing, at.position, at.speed)
print(f"eccentricity ratio {at.eccentricity_ratio:.3f}, loss {1e-3 * at.losses.power_loss:.0f} kW")
print(f"critical mass {1e-3 * rf.critical_mass(film).mass:.1f} t")
print(f"film temperature [degC]: {at.temperature - 273.15:.2f}")
