"""Films by the impedance map of bearings with openings."""
