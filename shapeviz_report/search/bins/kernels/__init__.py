"""Compiled loops of the search for bins: arrays in, arrays out, inputs trusted."""
