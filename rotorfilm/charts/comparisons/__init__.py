"""Charts of models side by side: error over cost, verdicts, limits."""
