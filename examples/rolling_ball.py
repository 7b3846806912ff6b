"""A ball on a lubricated plane, pushed: how long it oscillates, by the published steps and by better ones."""

from rotorfilm import ContactGrid, PointContact
from rotorfilm.bearings import FixedSteps, perturbed
from rotorfilm.studies import decay_time

contact = PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(24, 24)))
rest = contact.stationary()
start = perturbed(contact, rest, -0.2)
print(f"at rest: film H0 = {rest.central_film:.4f}, approach delta = {rest.delta:.4f}")
for name, control in (
    ("second order, dt = 0.1", FixedSteps(step=0.1)),
    ("implicit Euler, dt = 0.2, as published", FixedSteps(step=0.2, order=1)),
):
    run = contact.simulate(start, duration=12.0, W=1.0, control=control)
    time = decay_time(run, rest.delta)
    print(f"{name}: decays by e in a time of", round(time, 2))
