"""Checks of FMUs: description, calls, states, reference."""
