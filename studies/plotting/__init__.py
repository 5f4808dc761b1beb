"""Pictures of a run's results."""
