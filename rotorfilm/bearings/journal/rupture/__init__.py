"""Where the film of a splitting law begins and ends."""
