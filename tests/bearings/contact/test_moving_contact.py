"""The full contact as a Stepped model: at rest, in motion, its state as bytes, failures."""

import numpy as np
import pytest

from rotorfilm import ContactGrid, ConvergenceError, InputError, PointContact, RollingBall, Stepped
from rotorfilm.bearings import FixedSteps, MovingContact, moving_contact
from rotorfilm.bearings.contact.contact_steps import Stepper

CONTACT = PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(20, 20)))
MODEL = MovingContact(contact=CONTACT)


@pytest.fixture(scope="module")
def rest():
    return CONTACT.stationary()


def test_is_a_stepped_model():
    assert isinstance(MODEL, Stepped)
    assert [signal.name for signal in MODEL.outputs] == ["force_z", "central_film", "minimum_film"]


@pytest.mark.parametrize("load", [0.02, 0.3, 1.0, 2.5])
def test_rests_where_the_load_puts_it(load):
    state = CONTACT.stationary(load)
    found = MODEL.answer(MODEL.start([state.delta]))
    assert found == pytest.approx([load, state.central_film, state.minimum_film], rel=2e-5)


def test_a_lifted_ball_still_carries_a_little():
    loads = [MODEL.answer(MODEL.start([delta]))[0] for delta in (0.3, 1.0, 3.0)]
    assert 0.05 > loads[0] > loads[1] > loads[2] > 0.0


def test_steps_are_those_of_a_driven_contact(rest):
    # The approach goes linearly to its input in each step: the same as a run under a polygon.
    times, approaches = np.arange(5) * 0.05, rest.delta + np.array([0.0, 0.02, 0.05, 0.03, -0.04])
    state = MODEL.start([rest.delta])
    for k in range(4):
        state, output, work = MODEL.step(state, times[k], [approaches[k + 1]], 0.05)
        assert work["steps"] == 1
    run = CONTACT.drive(
        rest, duration=0.2, approach=lambda t: np.interp(t, times, approaches), control=FixedSteps(step=0.05)
    )
    assert output[0] == pytest.approx(run.carried_load[-1], rel=1e-4)
    assert output[1] == pytest.approx(run.central_film[-1], rel=1e-4)


@pytest.mark.closed_form
def test_units_of_a_ball():
    ball = RollingBall(
        radius=0.01, mass=0.033, modulus=206e9, poisson_ratio=0.3, viscosity=0.008,
        pressure_coefficient=5e-9, speed=0.9, load=10.0,
    )  # fmt: skip
    contact = ball.contact(ContactGrid(cells=(20, 20)))
    bare, si = MovingContact(contact=contact), moving_contact(ball, contact)
    scales = np.array([10.0, ball.film_scale, ball.film_scale])
    states = bare.start([-1.8]), si.start([-1.8 * ball.film_scale])
    assert si.answer(states[1]) == pytest.approx(scales * bare.answer(states[0]))
    after = (
        bare.step(states[0], 0.0, [-1.7], 0.05)[1],
        si.step(states[1], 0.0, [-1.7 * ball.film_scale], 0.05 * ball.time_scale)[1],
    )
    assert after[1] == pytest.approx(scales * after[0])


def test_long_steps_are_divided(rest):
    state = MODEL.start([rest.delta])
    _, output, work = MODEL.step(state, 0.0, [rest.delta - 0.1], 0.45)
    assert work["steps"] == 5
    fine = MovingContact(contact=CONTACT, largest=0.01)
    assert output[0] == pytest.approx(fine.step(state, 0.0, [rest.delta - 0.1], 0.45)[1][0], rel=5e-3)


def test_a_state_goes_through_bytes_to_the_last_bit(rest):
    state = MODEL.start([rest.delta])
    for k in range(3):
        state, _, _ = MODEL.step(state, 0.0, [rest.delta + 0.01 * k], 0.05)
    again = MODEL.unpack(MODEL.pack(state))
    after = [MODEL.step(each, 0.0, [rest.delta], 0.05)[1] for each in (state, again)]
    assert np.array_equal(*after)
    other = MovingContact(contact=PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(24, 24))))
    with pytest.raises(InputError, match=r"content must be of 288 cells, got shape \(3, 200\)"):
        other.unpack(MODEL.pack(state))


def test_a_step_that_fails_is_halved_then_given_up(rest, monkeypatch):
    state, whole = MODEL.start([rest.delta]), Stepper.advance

    def stubborn(self, levels, ends):
        if self.control.step > limit:
            raise ConvergenceError("too long")
        return whole(self, levels, ends)

    monkeypatch.setattr(Stepper, "advance", stubborn)
    limit = 0.02
    _, _, work = MODEL.step(state, 0.0, [rest.delta - 0.1], 0.05)
    assert work["steps"] == 4
    limit = 0.0
    with pytest.raises(ConvergenceError, match="too long"):
        MODEL.step(state, 0.0, [rest.delta - 0.1], 0.05)
    assert MODEL.answer(state)[0] == pytest.approx(1.0, rel=1e-5)


def test_names_the_broken_rule():
    with pytest.raises(InputError, match="contact must be a PointContact, got 3"):
        MovingContact(contact=3)
    with pytest.raises(InputError, match=r"largest must be finite and positive, got 0\.0"):
        MovingContact(contact=CONTACT, largest=0.0)
