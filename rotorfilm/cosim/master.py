"""The master: opens rotor and films, FMUs or models, and couples them by a scheme, or by the best one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import replace
from os import PathLike
from typing import Any

from ..bearings.stepped_reaction import SteppedReaction
from ..errors import InputError
from ..fmu.check.instance import extracted
from ..inputs.kinds import arguments
from ..model import Dynamic, Model
from ..rotors.force_law import BASE_TIME
from .auto import Auto, choose_scheme
from .cosim_run import CoSimulation, couple, require_times
from .fmu_slave import ExchangeRotor, FmuSlave
from .schemes.explicit import GaussSeidel
from .schemes.scheme import Scheme
from .slaves import InProcessSlave, Slave
from .stepped_partner import SteppedPartner
from .wiring import local_name

Path = str | PathLike[str]
Film = Path | Model | SteppedReaction


@arguments
def cosimulate(
    rotor_fmu: Path | Dynamic,
    film_fmu: Film | Mapping[str, Film],
    *,
    macro_step: float,
    duration: float,
    scheme: Scheme | Auto | str | None = None,
    progress: Callable[[float], None] | None = None,
) -> CoSimulation:
    """Couple a rotor with one or several films, FMUs of FMI 2.0 or 3.0 or models in this process, from t = 0.

    Signals are connected by their local names (`rotor.x` to `film.x`; in a rotor with several journals
    `rotor.left_x` to `x` of the film in the station `left`). The loop over the macro steps runs in C,
    in chunks between which it is watched and can be interrupted, where scheme and partners allow it:
    Gauss-Seidel, Jacobi, SI-exp and SI-exp3 over FMUs and over models with a kernel.

    Parameters
    ----------
    rotor_fmu : path or Dynamic
        It takes forces and gives motion. Co-Simulation will do for held forces; other schemes take an FMU for
        Model Exchange with directional derivatives, which the master integrates, or one with the inputs of a
        force law (`LawRotor`).
    film_fmu : path, Model or JFOFilm, or mapping of station to such
        It takes motion and gives forces, for Co-Simulation.
    macro_step : float [s]
        Distance of the communication points; the last step is shorter where it must be.
    duration : float [s]
    scheme : Scheme or Auto, optional
        `GaussSeidel()` by default: the film is evaluated at the rotor's new state, and its force is held over
        the next step. `Auto()`, or "auto" for short, finds the cheapest that is stable and accurate enough.
    progress : callable, optional
        Called for each step with the time reached [s], once a chunk of them is done.

    Raises
    ------
    InputError
        If an argument is out of range, the signals do not fit, an FMU lacks what the scheme needs, or no
        scheme is good enough for `Auto`.
    CouplingError
        If the forces alternate from step to step without decaying: the macro step is past the stability
        limit. The run stops there; carries the CoSimulation until then.
    ContactError
        If the journal reached the wall; carries the CoSimulation until then.
    FmuError
        If a file is no such FMU; as FmuRunError, with the CoSimulation until then, if an FMU fails.
    ConvergenceError
        If the scheme or the rotor's integration does not converge; carries the CoSimulation until then.
    """
    require_times(macro_step, duration)
    films = film_fmu if isinstance(film_fmu, Mapping) else {"": film_fmu}

    def attempt(scheme: Scheme, macro_step: float, duration: float) -> CoSimulation:
        return _run(rotor_fmu, films, scheme, macro_step, duration, None)

    wanted = _required(scheme)
    choice = None
    if isinstance(wanted, Auto):
        choice = choose_scheme(attempt, wanted, macro_step=macro_step, duration=duration)
        wanted = choice.scheme
    result = _run(rotor_fmu, films, wanted, macro_step, duration, progress)
    return result if choice is None else replace(result, choice=choice)


def _required(scheme: Scheme | Auto | str | None) -> Scheme | Auto:
    if scheme is None:
        return GaussSeidel()
    if isinstance(scheme, str):
        if scheme != "auto":
            raise InputError(f"scheme must be a scheme such as SIExp3(), or 'auto', got {scheme!r}")
        return Auto()
    return scheme


def _run(
    rotor: Path | Dynamic,
    films: Mapping[str, Film],
    scheme: Scheme,
    macro_step: float,
    duration: float,
    progress: Callable[[float], None] | None,
) -> CoSimulation:
    """Open all partners and couple them."""
    with ExitStack() as stack:
        if isinstance(rotor, str | PathLike):
            first: Slave = stack.enter_context(open_rotor(rotor, held=not scheme.needs.laws))
        else:
            first = InProcessSlave(rotor)
        others: dict[str, Slave] = {
            station: stack.enter_context(open_fmu(film))
            if isinstance(film, str | PathLike)
            else in_process(film)
            for station, film in films.items()
        }
        return couple(
            first, others, macro_step=macro_step, duration=duration, scheme=scheme, progress=progress
        )


def in_process(film: Any) -> Slave:
    """Return a film of this package as a partner."""
    return SteppedPartner(film) if isinstance(film, SteppedReaction) else InProcessSlave(film)


def open_fmu(path: Path) -> AbstractContextManager[FmuSlave]:
    """Extract and instantiate an FMU; free it and delete the files at the end, in any case.

    Parameters
    ----------
    path : path of the .fmu file

    Raises
    ------
    FmuError
        If the file cannot be read, is no Co-Simulation FMU of FMI 2.0 or 3.0, or cannot be instantiated.
    """
    return _opened(path, lambda description: False)


def open_rotor(path: Path, *, held: bool) -> AbstractContextManager[FmuSlave]:
    """Extract and instantiate a rotor FMU; see `open_fmu`.

    It is opened for Co-Simulation where that will do, otherwise for Model Exchange.

    Parameters
    ----------
    path : path of the .fmu file
    held : bool
        Whether it need not take more than held forces.
    """

    def exchanges(description: Any) -> bool:
        enough = held or any(local_name(v.name) == BASE_TIME for v in description.modelVariables)
        return description.modelExchange is not None and not (description.coSimulation is not None and enough)

    return _opened(path, exchanges)


@contextmanager
def _opened(path: Path, exchanges: Callable[[Any], bool]) -> Iterator[FmuSlave]:
    """Open an FMU, for Model Exchange where its description asks for that."""
    with extracted(path) as (description, folder):
        slave = (ExchangeRotor if exchanges(description) else FmuSlave)(description, folder)
        try:
            yield slave
        finally:
            slave.close()
