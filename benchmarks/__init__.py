"""Measurements of the descriptors: against other libraries, exact methods and analytic surfaces."""
