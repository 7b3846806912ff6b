"""Motion of a shaft along its axis and about it, beside its bending."""
