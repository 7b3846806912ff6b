"""Questions about rolling contacts."""
