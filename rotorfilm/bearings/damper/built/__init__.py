"""Squeeze-film dampers as built: seals at their ends, grooves, and the inertia of their oil."""
