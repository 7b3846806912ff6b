"""Motion over time, step by step: any models, or rotors that something shakes."""
