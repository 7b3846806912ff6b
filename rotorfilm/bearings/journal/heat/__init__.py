"""Journal films that warm: from one temperature to the temperature over and across the film."""
