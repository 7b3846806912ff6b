"""What families of films share: laws, geometry, tables and their cache, splines."""
