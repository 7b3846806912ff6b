"""Films whose stiffness K(s) depends on the motion: exponents, their count, critical masses, state spaces."""
