"""Journal films beside the reference."""
