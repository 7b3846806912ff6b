"""What rotors are certified by: stability under cross-coupling, separation margins, unbalance by mode."""
