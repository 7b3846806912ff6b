"""The search for the place of a journal under a load."""
