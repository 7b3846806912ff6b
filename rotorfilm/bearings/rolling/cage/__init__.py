"""Ball bearings whose cage turns, and all five degrees of freedom as a model."""
