"""Questions about flexible rotors."""
