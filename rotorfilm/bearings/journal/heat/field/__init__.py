"""The temperature over a journal film, and across it, as a field."""
