"""How results are read: rows with units for people, variables with units for data frames and data sets."""
