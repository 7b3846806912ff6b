"""FMUs of kernels of the C library."""
