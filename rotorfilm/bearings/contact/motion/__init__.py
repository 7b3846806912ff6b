"""The film of a point contact and its ball over time: steps, runs, loads, files."""
