"""Compiled loops of scorers: arrays in, arrays out, inputs trusted."""
