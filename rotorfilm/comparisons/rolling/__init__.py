"""Ball bearings over speed and preload, and the models of their ladder beside each other."""
