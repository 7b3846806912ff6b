"""The border: what public constructors and functions take, made SI floats and checked before it goes in."""
