"""Reports to hand over: a compressor, the damper of a turbocharger and the bearings of a spindle.

Each is one HTML page with the machine, inputs as read, what is left out, results, verdicts and models.
It needs no network, and a browser prints it. On the command line it is `rotorfilm report compressor.toml`.
"""

import math
from pathlib import Path

from rotorfilm import Scene

FOLDER = Path(__file__).parent
RPM = math.pi / 30.0

compressor = Scene.load(FOLDER / "compressor.toml").report(operating=(3500.0 * RPM, 4000.0 * RPM))
turbocharger = Scene.load(FOLDER / "turbocharger.toml").report()
spindle = Scene.load(FOLDER / "spindle_bearing.toml").report(
    vary={"ball_bearing.preload": ["50 N", "150 N", "400 N"]}
)
for name, report in {"compressor": compressor, "turbocharger": turbocharger, "spindle": spindle}.items():
    page = report.save(f"{name}.html")
    print(f"{page}, {page.stat().st_size / 1e6:.1f} MB")
    for verdict in report.verdicts:
        print(f"  {'fine' if verdict.fine else 'NOT FINE'}: {verdict.subject}: {verdict.text}")
print("verdicts that are not fine:", sum(not one.fine for one in compressor.verdicts))
