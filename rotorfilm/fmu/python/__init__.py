"""FMUs that run models in Python."""
