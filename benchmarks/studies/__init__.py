"""Cases and comparisons that only reproduce a paper or measure this package: run from a checkout."""
