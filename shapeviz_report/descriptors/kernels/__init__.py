"""Loops over arrays, compiled most of them. They trust their input; the descriptors that call them have checked it."""
