"""Heat of a journal's film: what takes it away, its balance, and the bearing as it runs."""
