"""The film in two dimensions on a ring of cells."""
