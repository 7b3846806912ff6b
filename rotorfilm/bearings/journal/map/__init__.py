"""Films by the impedance map of plain bearings."""
