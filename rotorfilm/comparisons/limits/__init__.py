"""Where methods fail: the atlas."""
