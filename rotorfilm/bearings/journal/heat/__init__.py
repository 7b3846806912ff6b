"""Heat of a journal's film: what takes it away, its balance, and the temperature over and across the film."""
