"""The model descriptions of FMI 2 and 3."""
