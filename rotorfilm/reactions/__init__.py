"""What reactions may have besides a force."""
