"""Critical speeds, with a proof that the list is complete."""
