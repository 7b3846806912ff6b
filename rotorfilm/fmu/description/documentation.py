"""The page that an FMU carries as documentation/index.html."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape

from .variables import Variable

PYTHON = {
    "Conventions": (
        "All values are in SI units. x and y are Cartesian, rotation is positive about +z (from x to y). A "
        "film force acts on the journal. Outputs are valid from the end of initialization and always belong "
        "to the present inputs, states and time. Inputs are held constant over a step; states may be set "
        "before the simulation starts."
    ),
    "Requirements": (
        "The model runs in Python (3.11 or later, with numpy and scipy) through PythonFMU's libraries, on "
        "the 64-bit platforms that the folder binaries lists. A host that is not Python itself must make "
        "libpython available to the library, on Linux for instance by LD_PRELOAD."
    ),
    "Statuses": (
        "A value that is not finite, an attempt to set an output, or a state at which the model has no "
        "answer (a journal at the wall) ends in fmi2Fatal with the values in the log, because PythonFMU has "
        "no way to fmi2Error. Only this instance is affected. Its later calls fail too, until it is reset or "
        "a saved FMU state is restored. A step that a model with states cannot make is answered by "
        "fmi2Discard with fmi2Terminated true; the states then are those at the start of the step. The log "
        "needs loggingOn."
    ),
}
"""What holds for every FMU that runs in Python."""

PYTHON_STEPPED = {
    **PYTHON,
    "Conventions": (
        "All values are in SI units. The model integrates in time by itself. When initialization ends it "
        "goes to the state that is stationary under the start values of the inputs. Outputs belong to the "
        "end of the last step; inputs set after it act in the next one. The state of the model is no list of "
        "variables: it goes through FMI as one block of bytes, to the last bit."
    ),
    "Statuses": (
        "A value that is not finite, an attempt to set an output, or start values without a stationary state "
        "end in fmi2Fatal with the values in the log, because PythonFMU has no way to fmi2Error. A step that "
        "cannot be made is answered by fmi2Discard with fmi2Terminated true; state, time and outputs stay "
        "those at the start of the step, which may be tried again with other inputs or a shorter step. The "
        "log needs loggingOn."
    ),
}
"""What holds for an FMU of a model with its own integrator."""

NATIVE = {
    "Conventions": (
        "Values are in SI units where a unit is given. Outputs are valid from the end of initialization and "
        "always belong to the present inputs, states, parameters and time. In Co-Simulation inputs are held "
        "constant over a step. States may be set before and during initialization, tunable parameters also "
        "between steps. Directional derivatives (in FMI 3.0 adjoint ones too) are exact: of outputs and "
        "derivatives by inputs and states. The FMU state holds everything, to the last bit."
    ),
    "Requirements": (
        "None: the model is a C library. Its sources, one C99 library without dependencies, are in sources/. "
        "Tables and start values are in resources/rotorfilm.bin, which belongs to this FMU only."
    ),
    "Statuses": (
        "A value that is not finite or out of its bounds, an attempt to set an output, and a state at which "
        "the model has no answer (a journal at the wall) is an error, with the values in the log; the "
        "instance works again after a reset or with a saved FMU state. In Model Exchange such a state is "
        "discarded instead, so that the integrator can try a smaller step. A step of Co-Simulation that a "
        "model with states cannot make is discarded; the states then are those at its start. A state beyond "
        "the table of a film is a warning, once."
    ),
    "Reference": (
        "reference.csv beside this page was computed by the model in Python: time, inputs, outputs. The "
        "inputs of a row are held until the next one, the outputs belong to the row's time and inputs. "
        "'rotorfilm fmu check' replays it."
    ),
}
"""What holds for every native FMU."""

KERNELS = {
    "journal": {
        "Model": (
            "Film force of a full cylindrical journal bearing of finite length, Reynolds equation with "
            "Reynolds rupture. x and y are Cartesian from the bearing center, rotation is positive about +z "
            "(from x to y), the force acts on the journal. With the eccentricity e = (x, y)/clearance and "
            "the source w = (vx, vy)/clearance - (speed/2) z^ x e, the film minimizes a quadratic "
            "functional, so that its force is a gradient:"
        ),
        "Equations": (
            "F = viscosity length radius^3 / clearance^2  dJ/dw\n"
            "J(e, w) = -|w|^2 exp(L0 + chi M(X, T)),  chi = |e|\n"
            "X = chi / (1 - chi^2)^(1/4),  T = (1 + cos(e, w)) / 2"
        ),
        "Validity": (
            "M and L0 are splines over X, T and ln(length / (2 radius)), fitted to converged solutions: one "
            "force within 1e-4 up to an eccentricity ratio of 0.97, length / diameter from 0.1 to 4; beyond "
            "the last node of the map it goes on as the film near the wall, or, where the map is no such "
            "film, as a power of X, with a warning that says how far it may be off. Laminar, isothermal, "
            "aligned, without grooves. Where w vanishes off the center the force is zero and has no "
            "derivative."
        ),
    },
    "grooved_journal": {
        "Model": (
            "Film force of a cylindrical journal bearing of finite length with axial grooves or several "
            "pads, open to ambient pressure; Reynolds equation with Reynolds rupture. x and y are Cartesian "
            "from the bearing center, rotation is positive about +z (from x to y), the force acts on the "
            "journal. With the eccentricity e = (x, y)/clearance at the angle theta and the source w = (vx, "
            "vy)/clearance - (speed/2) z^ x e at the angle phi, both from the axis of the openings, the film "
            "minimizes a quadratic functional, so that its force is a gradient:"
        ),
        "Equations": (
            "F = viscosity length radius^3 / clearance^2  dJ/dw\n"
            "J(e, w) = -|w|^2 exp(L0(phi) + chi M(X, theta, s)),  chi = |e|\n"
            "X = chi / (1 - chi^2)^(1/4),  tan s = squeeze tan(phi - theta)"
        ),
        "Validity": (
            "M and L0 are splines over X and the angles, made for these openings and this length / diameter: "
            "radius and length are fixed, clearance and viscosity tunable. The table `map` is length / "
            "diameter, the last X, squeeze and the axis [rad]; beyond the last X the force goes on as that "
            "of the film near the wall, as far as the openings leave it, with a warning. Laminar, "
            "isothermal, aligned. Where w vanishes the force is zero and has no derivative."
        ),
    },
    "short_journal": {
        "Model": (
            "Film force of a full cylindrical journal bearing that is short: flow along the axis only, "
            "pressure on the half circle on which the film is fed (Ocvirk). x and y are Cartesian from the "
            "bearing center, rotation is positive about +z (from x to y), the force acts on the journal. "
            "With the eccentricity e = (x, y)/clearance and the source w = (vx, vy)/clearance - (speed/2) "
            "z^ x e, and a, b the parts of e along w and across it, the force is the gradient of a closed "
            "form:"
        ),
        "Equations": (
            "F = viscosity length^3 radius / clearance^2  dJ/dw\n"
            "J(e, w) = -|w|^2 I(a, b) / 2,  q^2 = 1 - a^2 - b^2\n"
            "I = atan2(q, -a) (q^2 + 3 a^2) / q^5 + 3 a / q^4"
        ),
        "Validity": (
            "For length / (2 radius) up to about 0.25, 0.5 for static forces at small eccentricity: in large "
            "motion the force is off by 6 % (median) at 0.25, by 23 % at 0.5. Laminar, isothermal, aligned, "
            "without grooves. Where w vanishes off the center the force is zero and has no derivative."
        ),
    },
    "damper": {
        "Model": (
            "Force of a squeeze-film damper with a solid or porous cage, and of its retainer springs, on the "
            "rotor. The race does not spin: there is no speed. x and y are Cartesian from the bearing "
            "center. With the eccentricity e = (x, y)/clearance and its rate w = (vx, vy)/clearance, the "
            "film minimizes a quadratic functional, so that its force is a gradient:"
        ),
        "Equations": (
            "F = viscosity radius length^3 / clearance^2  dJ/dw - stiffness (x, y)\n"
            "J(e, w) = -|w|^2 exp(L0 + chi M(X, T)),  chi = |e|\n"
            "X = chi / (1 - chi^2)^(1/4),  T = (1 + cos(e, w)) / 2"
        ),
        "Validity": (
            "M is a spline over X and T, made for this damper. Fixed is what it holds for: length and "
            "clearance where the cage is porous, radius and length where the film is of finite length. The "
            "springs are preloaded so that they carry the static load. Beyond the last X, the table reach, "
            "the force goes on as that of the film near the wall, or, where the map is no such film (porous "
            "cages, films without rupture), as a power of X, with a warning. Laminar, isothermal, aligned, "
            "without oil inertia. Where the rotor is at rest off the center the film force is "
            "zero and has no derivative."
        ),
    },
    "rigid_rotor": {
        "Model": (
            "One journal's share of a rigid rotor that moves without tilting. x and y are Cartesian, "
            "rotation is positive about +z (from x to y); the inputs are the film force on the journal. With "
            "the angle p(t) of the unbalance, w = dp/dt and alpha = dw/dt:"
        ),
        "Equations": (
            "mass d2x/dt2 = force_x + mass gravity_x + static_force_x + unbalance (w^2 cos p + alpha sin p)\n"
            "mass d2y/dt2 = force_y + mass gravity_y + static_force_y + unbalance (w^2 sin p - alpha cos p)"
        ),
        "Validity": (
            "Small displacements, no tilting, a speed given over time (piecewise linear). The rotor knows no "
            "wall: the bearing's film ends the motion there."
        ),
    },
    "contact": {
        "Model": (
            "Lubricated rolling contacts of balls by their reduced law. The approach d of a contact is gap + "
            "(motion u): the distance of the ball's center beyond first touch, negative in contact. The "
            "force of a contact is that of the stationary contact, and what the dynamic stiffness of the "
            "film adds to it; a film does not pull, and a ball beyond `offset` no longer drives the states. "
            "The outputs are push times the forces:"
        ),
        "Equations": (
            "dx/dt = A x + B (min(d, offset) - operating)\n"
            "force = max(0, scale ((offset - d)/span)^exponent + C x + D (min(d, offset) - operating))\n"
            "output = push force,  d = gap + motion u"
        ),
        "Validity": (
            "The table `law` is offset, span [m], exponent, scale [N], operating [m], and the smallest and "
            "largest load [N] of the fit; beyond these loads there is a warning. The state space is the "
            "linearized film under the load `scale`, fitted to six radians per transit time; its errors are "
            "those of the model that was exported. Isothermal, smooth surfaces, one rolling speed."
        ),
    },
    "bush_wear": {
        "Model": (
            "A rigid shaft that rubs in a thin polymer liner and wears it by melting, under a load that does "
            "not fall. Temperatures are above the ambient one. Half the contact angle alpha and the contact "
            "temperature T follow from load, speed and the wear moment W; q_m is what friction heat has left "
            "over at the melting point. In Co-Simulation W is advanced by an implicit step of fourth order "
            "with error control; beginning and end of melting and the change of the sense of rotation are "
            "event indicators."
        ),
        "Equations": (
            "c(T) F(alpha) = a_1 N + W,  F = (alpha - sin(2 alpha)/2)/cos(alpha),  N = load/force unit\n"
            "T = min(melting point, temperature at which losses equal friction heat)\n"
            "dW/dt = q_m N/(melting_heat radius qbar),  q_m = max(0, omega R_1 f qbar - Q_1 - Q_2)"
        ),
        "Validity": (
            "Evtushenko & Kovalenko (1993), re-derived. Contact pressure of the shape cos(phi) - cos(alpha). "
            "The table `bush` holds what is fixed: clearance, thermal closing, a_1, G R_1, conductances of "
            "shaft and liner, melting point, whether heat leaves the whole shaft, radii, thickness, force "
            "unit, shear modulus. No abrasive wear, no heat stored."
        ),
    },
    "bush_reaction": {
        "Model": (
            "Force and friction torque of a polymer bush on the shaft in it, with wear depths at nodes of "
            "the liner: loads may fall and turn, the shaft may leave the liner and come back. The contact is "
            "held at the melting point. Where the depth d of the shaft in the liner is positive it carries "
            "pressure q; what friction heat leaves over melts the liner. In Co-Simulation the wear is "
            "advanced by extrapolated implicit Euler steps with error control under held inputs; nodes that "
            "enter or leave the contact, melting, and the sense of rotation are event indicators."
        ),
        "Equations": (
            "q = (G/a_1) max(0, d),  d = (e.n - Delta)/R + ln(R_2/R) B T_* - v/R\n"
            "e = (x, y) + retardation (vx, vy)\n"
            "dv/dt = q f omega R_1 (1 - omega_c/omega)/melting_heat where the contact melts"
        ),
        "Validity": (
            "Evtushenko & Kovalenko (1993), re-derived. Second order in the distance of the nodes. Below the "
            "critical speed a real contact is colder and carries less. The tables `bush` and `profile` hold "
            "what is fixed. No abrasive wear, no heat stored."
        ),
    },
    "rotor_system": {
        "Model": (
            "A rotor and the film bearings it runs in, as one system. x and y are Cartesian, rotation is "
            "positive about +z (from x to y); a film force acts on the journal. With the angular speed w, "
            "the angle p(t) turned, w = dp/dt, a = dw/dt, and the motion of the journals in their housings:"
        ),
        "Equations": (
            "q'' = (steady + w spin) (q, q') + push u + carry f + weight\n"
            "      + unbalance (w^2 cos p + a sin p, w^2 sin p - a cos p)\n"
            "f = film force of each bearing at (motion (q, q'), w)"
        ),
        "Validity": (
            "Small displacements of the rotor, a speed given over time (piecewise linear); each film as the "
            "FMU of that bearing says. q are the coordinates of the rotor, reduced or not. Co-Simulation "
            "integrates rotor and films together by RODAS, of order 4, L-stable, with the exact Jacobian: no "
            "macro step is too long for stability."
        ),
    },
    "linear": {
        "Model": "Linear time-invariant system, exported from python-control.",
        "Equations": "dx/dt = A x + B u\ny = C x + D u",
        "Validity": "That of the linearization the matrices come from.",
    },
}
"""What holds for the FMUs of each kernel of the C library."""

PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{title}</title></head>
<body>
<h1>{title}</h1>
{body}
</body>
</html>
"""


def to_html(title: str, variables: tuple[Variable, ...], texts: Mapping[str, str], parameters: str) -> bytes:
    """Return the page.

    Parameters
    ----------
    title : str
        One line on the model.
    variables : tuple of Variable
    texts : mapping of str to str
        Paragraphs by their headings; "Equations" keep their lines.
    parameters : str
        The numbers of the model, as text.
    """
    sections = {
        "Variables": _table(variables),
        **{name: _paragraph(name, text) for name, text in texts.items()},
        "Parameters": f"<pre>{escape(parameters)}</pre>",
    }
    body = "\n".join(f"<h2>{heading}</h2>\n{content}" for heading, content in sections.items())
    return PAGE.format(title=escape(title), body=body).encode()


def _paragraph(name: str, text: str) -> str:
    tag = "pre" if name == "Equations" else "p"
    return f"<{tag}>{escape(text)}</{tag}>"


def _table(variables: tuple[Variable, ...]) -> str:
    heading = ("Name", "Causality", "Unit", "Start", "Nominal", "Description")
    rows = [
        (
            variable.name,
            _kind(variable),
            variable.unit or "",
            "calculated" if variable.start is None else f"{variable.start:g}",
            "" if variable.nominal is None else f"{variable.nominal:.3g}",
            variable.description,
        )
        for variable in variables
    ]
    lines = [_row("th", heading), *(_row("td", row) for row in rows)]
    return "<table>\n" + "\n".join(lines) + "\n</table>"


def _kind(variable: Variable) -> str:
    if variable.switch:
        return "event indicator (local)"
    if variable.causality == "local":
        return "state (local)" if variable.state is None else "derivative (local)"
    return f"{variable.variability} parameter" if variable.causality == "parameter" else variable.causality


def _row(tag: str, cells: tuple[str, ...]) -> str:
    return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"
