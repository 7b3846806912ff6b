"""Films by splitting: products of axial and circumferential functions."""
