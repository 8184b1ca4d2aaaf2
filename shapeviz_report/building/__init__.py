"""From a database to its site: the order of the stages, what runs them, and what each asks."""
