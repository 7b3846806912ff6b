"""Questions about dampers."""
