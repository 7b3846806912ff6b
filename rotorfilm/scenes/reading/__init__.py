"""How tables of scene files are read: fields, units, names, and what a wrong one may have meant."""
