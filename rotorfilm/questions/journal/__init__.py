"""Questions about journal bearings."""
