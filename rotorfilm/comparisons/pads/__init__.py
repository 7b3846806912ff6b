"""Bearings made of pads side by side, and the films of their pads."""
