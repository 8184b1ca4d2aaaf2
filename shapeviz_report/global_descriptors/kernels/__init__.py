"""Compiled loops of the global descriptors."""
