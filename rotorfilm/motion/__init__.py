"""Motion over time, periodic orbits and circular ones."""

from typing import TYPE_CHECKING

from ..sources import show

if TYPE_CHECKING:
    from .circular.bistable import (
        BistableMap,
        bistability_limit as bistability_limit,
        bistable_map as bistable_map,
    )
    from .circular.branches import (
        Fold,
        OrbitBranch,
        SynchronousOrbits,
        orbits_over_speed as orbits_over_speed,
        synchronous_orbits as synchronous_orbits,
    )
    from .circular.cartesian_motion import (
        cartesian_state,
        polar_acceleration,
        polar_series,
        transmitted_ratio as transmitted_ratio,
    )
    from .compiled.simulate_rotor import simulate_rotor as simulate_rotor
    from .periodic.basin import BasinScan as BasinScan, basin_scan as basin_scan
    from .periodic.continuation import (
        Bifurcation as Bifurcation,
        OrbitCurve as OrbitCurve,
        OrbitEvent as OrbitEvent,
        continue_orbits as continue_orbits,
    )
    from .periodic.cracked_response import (
        CrackedResponse as CrackedResponse,
        cracked_response as cracked_response,
    )
    from .periodic.hopf import HopfPoint as HopfPoint, hopf_point as hopf_point
    from .periodic.periodic_orbit import PeriodicOrbit as PeriodicOrbit, periodic_orbit as periodic_orbit
    from .transient.ring_contacts import RingContacts as RingContacts, ring_contacts as ring_contacts
    from .transient.simulate import simulate as simulate
    from .variable_compliance import (
        VariableCompliance as VariableCompliance,
        variable_compliance as variable_compliance,
    )
else:
    show(__name__)
