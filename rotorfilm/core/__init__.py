"""What every part uses: models and signals, units, errors, results, checked files."""
