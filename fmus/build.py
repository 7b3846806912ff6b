"""Build the shipped FMUs, of FMI 2.0 and 3.0, into fmus/dist/ and check each.

    python fmus/build.py                  build and check
    python fmus/build.py --platforms all  for all platforms (needs the extra `platforms`)
    python fmus/build.py --reference      compute the reference trajectories again, from the models directly

A recipe is a module here with COMPONENT, model(), start() and stimulus(). A reference CSV has the columns
time, inputs, outputs; the inputs of a row are held until the next row, the outputs belong to the row's time.
"""

import argparse
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from rotorfilm.core.files import write_atomically
from rotorfilm.core.signals import to_fmi_name
from rotorfilm.cosim import open_fmu
from rotorfilm.fmu import CheckItem, check_fmu, export_fmu
from rotorfilm.fmu.export import as_exported
from rotorfilm.fmu.reference import to_csv

HERE = Path(__file__).parent
RECIPES = ("journal", "rotor", "flexible_rotor", "damper", "bush", "worn_bush", "contact")
VERSIONS = ("2.0", "3.0")

TOLERANCE = 1e-8
"""Largest accepted deviation from the reference, in nominal values."""


def load_recipe(name: str) -> Any:
    """Return the recipe module `name` of this folder."""
    spec = spec_from_file_location(f"fmu_recipe_{name}", HERE / f"{name}.py")
    recipe = module_from_spec(spec)
    spec.loader.exec_module(recipe)
    return recipe


def columns(recipe: Any) -> list[str]:
    """Return the column names of a reference CSV."""
    model = as_exported(recipe.model())
    signals = [*model.inputs, *model.outputs]
    return ["time", *(to_fmi_name(recipe.COMPONENT, signal.name) for signal in signals)]


def compute_reference(recipe: Any) -> NDArray:
    """Return the reference table, computed by calling the model itself."""
    model = as_exported(recipe.model())
    time, inputs = recipe.stimulus()
    states = held_states(model, time, inputs)
    outputs = [model.output(t, x, u) for t, x, u in zip(time, states, inputs, strict=True)]
    return np.column_stack([time, inputs, np.array(outputs)])


def held_states(model: Any, time: NDArray, inputs: NDArray) -> list[NDArray]:
    """Return the state at each time, integrated by another method than the FMU's."""
    if not model.states:
        return [np.zeros(0)] * len(time)
    nominal = np.array([signal.nominal for signal in model.states])
    states = [model.initial_state]
    for t, end, u in zip(time[:-1], time[1:], inputs[:-1], strict=True):
        solution = solve_ivp(
            lambda s, x, u=u: model.derivative(s, x, u),
            (t, end),
            states[-1],
            method="RK45",
            rtol=1e-12,
            atol=1e-12 * nominal,
        )
        states.append(solution.y[:, -1])
    return states


def reference_path(name: str) -> Path:
    """Return the path of a reference CSV."""
    return HERE / "reference" / f"{name}.csv"


def write_reference(name: str) -> Path:
    """Compute and write a reference CSV."""
    recipe = load_recipe(name)
    path = reference_path(name)
    path.parent.mkdir(exist_ok=True)
    return write_atomically(path, to_csv(columns(recipe), compute_reference(recipe)))


def read_reference(name: str) -> NDArray:
    """Return the table of a reference CSV."""
    return np.loadtxt(reference_path(name), delimiter=",", skiprows=1)


def build(name: str, version: str, folder: Path, platforms: str = "host") -> Path:
    """Export the FMU of a recipe into `folder`, as `fmi2/name.fmu` or `fmi3/name.fmu`."""
    recipe = load_recipe(name)
    return export_fmu(
        recipe.model(),
        folder / f"fmi{version[0]}" / f"{name}.fmu",
        version,
        backend="native",
        platforms=platforms,
        component=recipe.COMPONENT,
        start=recipe.start(),
    )


def deviation(name: str, path: Path) -> float:
    """Return the largest deviation of an FMU from its reference, in nominal values."""
    recipe = load_recipe(name)
    reference = read_reference(name)
    outputs = recipe.model().outputs
    answers = run(path, reference[:, 0], reference[:, 1 : -len(outputs)])
    nominal = np.array([signal.nominal for signal in outputs])
    return float(np.max(np.abs(answers - reference[:, -len(outputs) :]) / nominal))


def run(path: Path, time: NDArray, inputs: NDArray) -> NDArray:
    """Return the outputs of an FMU at the given times, shape (n, n_outputs), with inputs held between.

    The time starts at zero; inputs and outputs are in the order of the FMU.
    """
    with open_fmu(path) as fmu:
        rows = [dict(zip(fmu.inputs, u, strict=True)) for u in inputs.tolist()]
        fmu.start(rows[0])
        answers = [fmu.get()]
        for t, end, following in zip(time[:-1], time[1:], rows[1:], strict=True):
            fmu.step(t, end - t)
            fmu.set(following)
            answers.append(fmu.get())
        return np.array([[answer[name] for name in fmu.outputs] for answer in answers])


def main() -> int:
    """Build and check all recipes; return the number of FMUs that are not right."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--platforms", choices=("host", "all"), default="host", help="platforms of the FMUs")
    parser.add_argument("--reference", action="store_true", help="compute the reference trajectories again")
    arguments = parser.parse_args()
    if arguments.reference:
        for name in RECIPES:
            print(f"{write_reference(name)} written")
        return 0
    return sum(
        _report(name, build(name, version, HERE / "dist", arguments.platforms))
        for name in RECIPES
        for version in VERSIONS
    )


def _report(name: str, path: Path) -> bool:
    """Print what is measured on an FMU; return whether it is wrong."""
    worst, items = deviation(name, path), check_fmu(path)
    wrong = worst > TOLERANCE or any(item.passed is False for item in items)
    print(f"{path}: {'WRONG' if wrong else 'right'}, deviation {worst:.1e}")
    for item in items:
        print(f"    {_line(item)}")
    return wrong


def _line(item: CheckItem) -> str:
    figure = "" if item.figure is None else f"{item.figure:.1e} "
    return f"{item.check}: {figure}{item.remark}"


if __name__ == "__main__":
    sys.exit(main())
