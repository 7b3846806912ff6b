"""The monitor of a co-simulation on generated runs: is every bad one found, and no good one stopped.

Run as `python benchmarks/coupling_monitor.py [COUNT]`, 100 of each kind by default.
"""

import sys
import warnings

from studies.coupling_cases import SPEED, coupling_cases

from rotorfilm import PartialResultError
from rotorfilm.core import CouplingWarning
from rotorfilm.cosim import InProcessSlave, couple


def outcome(case):
    """Return the error that stopped a run, or nothing, and the result."""
    try:
        result = couple(
            InProcessSlave(case.rotor),
            InProcessSlave(case.bearing),
            macro_step=case.macro_step,
            duration=case.duration,
            scheme=case.scheme,
        )
    except PartialResultError as error:
        return type(error).__name__, error.partial
    return "", result


def judged(case):
    """Return whether the monitor was right about a case, and a line on it."""
    stopped, result = outcome(case)
    steps = result.trajectory.work["steps"]
    reached = steps * case.macro_step / case.duration
    error = case.orbit_error(result.trajectory) if steps else float("nan")
    warned = "warned" if result.watch.warnings else ""
    line = (
        f"{'bad ' if case.bad else 'good'} {case.scheme.label:15s} factor {case.factor:5.2f} "
        f"{case.macro_step * SPEED * 57.2958:6.2f} deg, orbit error {error:.1e} C, "
        f"{stopped or 'not stopped'} at {100 * min(reached, 1.0):3.0f} % {warned}"
    )
    return bool(stopped) == case.bad, bool(result.watch.warnings), error, line


def main():
    """Print what the monitor made of all runs; return how many it got wrong."""
    wrong = 0
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    warnings.simplefilter("ignore", CouplingWarning)
    for bad in (True, False):
        verdicts = [judged(case) for case in coupling_cases(count, bad=bad)]
        right, warned = (sum(verdict[k] for verdict in verdicts) for k in (0, 1))
        print(f"{'bad: found' if bad else 'good: not stopped'} {right} of {count}; warned {warned}")
        wrong += count - right
        errors = sorted(verdict[2] for verdict in verdicts)
        middle = errors[count // 2]
        print(f"  orbit error: {errors[0]:.1e} to {errors[-1]:.1e} of the clearance, median {middle:.1e}")
        for is_right, _, _, line in verdicts:
            if not is_right:
                print("  EXCEPTION", line)
    return wrong


if __name__ == "__main__":
    sys.exit(main())
