"""The film of a point contact: equations, scheme, Newton and Krylov solvers."""
