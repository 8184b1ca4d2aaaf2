"""Compiled loops over arrays. They trust their input; the descriptors that call them have checked it."""
