"""The loop over the macro steps of a run: what it keeps, and its compiled form."""
