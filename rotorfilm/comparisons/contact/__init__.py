"""Published cases of a rolling ball, judged."""
