"""Porous squeeze-film damper: what decides the statements of Akhverdiev et al. on transients and on feed.

It takes the cases of `damper_paper.py`, and two minutes.
"""

import runpy
from pathlib import Path

import numpy as np

PAPER = runpy.run_path(str(Path(__file__).with_name("damper_paper.py")))
support, orbits, transient, fed, UNIT = (
    PAPER[name] for name in ("support", "orbits", "transient", "fed", "UNIT")
)

# The scan leaves open whether -2.8 is beta or its rate.
for beta, rate in ((-2.8, 0.0), (0.0, -2.8)):
    for label, case in fed.items():
        time, ratio = transient(support(0.12, **case), beta, rate)
        k = int(np.argmax(ratio))
        print(
            f"beta {beta:g}, its rate {rate:g}, {label}: T_r starts at {ratio[0]:.2f}, has its maximum "
            f"{ratio[k]:.2f} at T = {time[k]:.2f} and is {ratio[-1]:.2f} at T = 20"
        )

for label, case in fed.items():
    found = orbits(support(0.04, **case))
    at = next(fold.unbalance for fold in found.folds if fold.upward)
    low, high = found.branches[0], found.branches[-1]
    ends = low.transmissibility[-1], np.interp(at, high.unbalance, high.transmissibility)
    print(
        f"{label}: jump at U = {at / UNIT:.3f} from T_r = {ends[0]:.2f} to {ends[1]:.2f}, "
        f"greatest {high.transmissibility.max():.2f}"
    )
