"""The structures of the C library, as ctypes reads them."""
