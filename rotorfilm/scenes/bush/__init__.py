"""Bush."""
