"""Compiled loops of projections: arrays in, arrays out, inputs trusted."""
