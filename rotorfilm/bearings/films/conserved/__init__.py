"""The film that conserves its oil where it ruptures: cells, compiled solver, small motions."""
