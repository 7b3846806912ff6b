"""Which schemes the loop in C knows, and as what."""

from __future__ import annotations

from typing import NamedTuple

from ..coupling_replay import Starting
from ..schemes.explicit import GaussSeidel, Jacobi
from ..schemes.implicit import SIExp, SIExp3
from ..schemes.scheme import Scheme


class Plan(NamedTuple):
    """A scheme as the loop in C knows it; see couple.h."""

    scheme: int
    degree: int = 0
    gentle: bool = False
    third: bool = False


def plan_of(scheme: Scheme) -> Plan | None:
    """Return how the loop in C takes a scheme; None if it does not, as those that go back."""
    if type(scheme) is Starting:
        inner = plan_of(scheme.scheme)
        return None if inner is None else inner._replace(gentle=True)
    if type(scheme) is GaussSeidel or type(scheme) is Jacobi:
        return Plan(int(type(scheme) is Jacobi), scheme.degree, scheme.degree > 1)
    if type(scheme) is SIExp or type(scheme) is SIExp3:
        return Plan(2, third=type(scheme) is SIExp3)
    return None
