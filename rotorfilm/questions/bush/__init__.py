"""Questions about bushes."""
